// What to command near singular joints: the correction without the large joint motions that a lost direction asks for.
#pragma once

#include "effects/corrected_robot.hpp"

namespace demecal {

/// As command_reaching(), but joints stay within a few times the correction itself (position over 0.3 m, and angle): in
/// directions that the arm has nearly lost the correction is left, of orientation rather than of position, and the
/// status is `damped` where that leaves more than 5 um or 0.05 mrad.
InverseSolution nearby_command(const CorrectedRobot& robot, const Eigen::Isometry3d& goal, const Stop& start);

}  // namespace demecal
