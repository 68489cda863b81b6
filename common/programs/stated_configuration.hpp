// Whether a correction leaves the configuration that a target's line states, and that stays as it is: the controller
// would take the corrected pose for another one's.
#pragma once

#include <string>

#include "kinematics/chain.hpp"
#include "parsed_programs/program.hpp"

namespace demecal::inline programs {

/// How the arm, which the target means to have the joints `nominal`, is in another configuration than is stated at
/// `command`, and what to do: "the correction takes joint 6 from .. to .., ..". Empty: it is in the one that is stated,
/// or none is.
std::string leaving_stated(const Target& target, const Chain& arm, const JointVector& nominal,
                           const JointVector& command);

}  // namespace demecal::inline programs
