// Short formulas outside the catalogue: errors of a joint that depend on two or three circumstances at once.
#pragma once

#include <vector>

#include "effects/effect.hpp"

namespace demecal {

/// Symbolic effects of every revolute joint: sines and cosines of m q_a + n q_b and of q_a +- q_b +- q_c, the same
/// waves with a phase that is to be found, products of joint values with each other and with sines and cosines, and
/// what the approach sign, the warming and gravity's torque multiply. Only circumstances that the evidence holds and
/// joints that move take part. What evolution finds most often where it is let loose, tried without evolving.
std::vector<Effect> formula_library(const Robot& robot, const Evidence& evidence);

}  // namespace demecal
