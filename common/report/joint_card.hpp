// One joint's part of the page.
#pragma once

#include <string>

#include "report/fitness_history.hpp"
#include "report/joint_entry.hpp"

namespace demecal {

/// The joint's error, its correction as plot and formula or why it has none, and the course of its evolution.
std::string joint_card(const JointEntry& joint, const FitnessHistory& history);

/// The range in degrees, "-160.0 to 160.0"; a dash where there is none.
std::string range_deg(const JointEntry& joint);

/// An angle in mrad with three decimals; a dash where there is none.
std::string mrad(std::optional<double> angle_rad);

}  // namespace demecal
