// Where an arm is likely to stand: a fixed, even sample, by which laws see what would never show.
#pragma once

#include <vector>

#include "effects/effect.hpp"

namespace demecal {

/// 64 states with `payload_kg`, joints within the measured ranges (where these are unknown: a turn, or a prismatic
/// joint's limits), spread evenly by a Halton sequence.
std::vector<ArmState> sampled_states(const Robot& robot, const Evidence& evidence, double payload_kg);

/// |torque| (Nm or N) of gravity on the joint in each state, ascending.
std::vector<double> torques_by_size(const Robot& robot, const std::vector<ArmState>& states, int joint);

/// Loads and levers below this (N, Nm, m) are rounding.
inline constexpr double kNoLoad = 1e-9;

}  // namespace demecal
