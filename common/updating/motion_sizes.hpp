// How far effects move an arm at given poses, and which of them are of gears and encoders.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "data/data_set.hpp"
#include "effects/effect.hpp"
#include "prediction/corrected_robot.hpp"

namespace demecal::inline updating {

/// Root mean square of what a unit of each coefficient of the robot's effects moves at the poses, rad or m: by effect
/// and coefficient, wherever the effect was found.
std::vector<std::vector<double>> unit_motion_sizes(const CorrectedRobot& robot, const DataSet& data,
                                                   std::span<const std::size_t> poses);

/// Their errors drift as AssumedDrift::transmission_rad.
bool is_of_transmission(const Effect& effect);

}  // namespace demecal::inline updating
