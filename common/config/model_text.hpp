// Model files: what a calibration found, for evaluate, apply and people.
#pragma once

#include <filesystem>
#include <string>

#include "closed_calibration/calibrated_model.hpp"

namespace demecal {

/// The text of a model.yaml: the robot, where the numbers came from, the identified numbers with standard errors, and
/// every joint's correction with its range, bound and jumps.
std::string model_text(const CalibratedModel& model);

/// The model of a model.yaml. Predictions need `robot` alone; estimates and notes are for people and not read back.
/// Throws InputError with file, line, value and rule at the first fault.
CalibratedModel load_model(const std::filesystem::path& path);

}  // namespace demecal
