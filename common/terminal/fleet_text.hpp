// A fleet's numbers as a table for people.
#pragma once

#include <string>

#include "closed_calibration/calibrated_model.hpp"

namespace demecal::inline terminal {

/// Of the model of a fleet: mean, spread and the mean's standard error of every number with its unit, what the columns
/// mean, and how the joints' corrections differ.
std::string fleet_table(const CalibratedModel& fleet);

}  // namespace demecal::inline terminal
