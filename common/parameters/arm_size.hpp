// How large an arm is over its reference, where nothing but what it touches tells of it.
#pragma once

#include <Eigen/Core>

#include "parameters/parameter_space.hpp"

namespace demecal::inline parameters {

/// The change of the arm's relative size with each parameter (1/m, 1/rad): one along the direction that makes every
/// length of the arm larger by one and the same share, and none along whatever the prior of makers' figures holds to be
/// independent of that direction. All zero where the parameters have no such direction: with lengths that are not free,
/// or a prismatic joint, whose travel is a length of its own.
Eigen::VectorXd arm_size_slopes(const ParameterSpace& space);

}  // namespace demecal::inline parameters
