// Whether an arm with a spherical wrist stands the same way at two joint positions: shoulder, elbow and wrist on the
// same sides.
#pragma once

#include <optional>

#include "kinematics/chain.hpp"

namespace demecal::inline programs {

/// Nothing where the arm is not of six revolute joints with parallel axes 2 and 3 and a wrist whose axes meet, or where
/// one of the positions is so near to a singular one that a side cannot be told.
std::optional<bool> same_posture(const Chain& arm, const JointVector& one, const JointVector& other);

}  // namespace demecal::inline programs
