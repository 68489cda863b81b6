// What to command so that the real robot's tool stands at a given pose.
#pragma once

#include "effects/corrected_robot.hpp"

namespace demecal {

/// The joints to command so that the model predicts its own tool at `goal` (in the model's measurements' frame), found
/// from `start`, whose approach, payload, temperature and time are taken as given. Where there is no such inverse
/// within half a radian (or metre) of `start` in every joint it is damped least squares: see corrected_command().
InverseSolution command_reaching(const CorrectedRobot& robot, const Eigen::Isometry3d& goal, const Stop& start,
                                 const InverseOptions& options = {});

}  // namespace demecal
