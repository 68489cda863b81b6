// What the poses themselves lack, whatever the robot: joints that do not move, points on a line, copies of rows.
#pragma once

#include <vector>

#include "data/data_set.hpp"
#include "data_check/finding.hpp"

namespace demecal {

/// Joints that move by less than 2 degrees (5 mm) over the calibration poses, and measured points on a line or plane.
std::vector<Finding> find_lacking_spread(const DataSet& data);

/// Of data without positions: joint angles said to be in degrees that are all as small as radians are.
std::vector<Finding> find_small_angles(const DataSet& data);

/// Takes rows out that repeat another to the last digit of what was measured, joints included, and names each: a repeat
/// with noise does not, unless its digits are as coarse as the noise.
std::vector<Finding> take_out_copies(DataSet& data);

}  // namespace demecal
