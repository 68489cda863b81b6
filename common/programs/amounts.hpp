// Numbers as sentences of this room write them.
#pragma once

#include <string>

#include "kinematics/chain.hpp"

namespace demecal {

/// With so many decimals.
std::string fixed_text(double value, int decimals);
/// A joint's value or a change of it, from rad or m: "12.3456 deg", "7.890 mm".
std::string joint_amount(const Joint& joint, double value);
/// "joint 3", from 0.
std::string joint_label(int joint);

}  // namespace demecal
