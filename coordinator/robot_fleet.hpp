// Models that are the mean of several robots of one type: what commands say of them, and where they are refused.
#pragma once

#include <string>

#include "closed_calibration/calibrated_model.hpp"

namespace demecal {

/// Says on standard error, where it is so, that the model is no calibrated robot.
void say_if_fleet(const CalibratedModel& model, const std::string& file);

/// Throws InputError where it is so: `what` needs the model of one robot.
void require_one_robot(const CalibratedModel& model, const std::string& file, const std::string& what);

}  // namespace demecal
