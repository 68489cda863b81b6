// The several joint positions in which an arm reaches one pose, and which of them a straight line ends in.
#pragma once

#include <optional>
#include <vector>

#include "programs/nominal_joints.hpp"

namespace demecal {

/// Joints at which the nominal arm's tool point (axes of the flange) stands at `tool`, no two alike but for whole
/// turns, each in the turn within its limits that is nearest to `reference`; those within the limits where there are
/// any. They are searched for from a fixed set of joints and from `reference`, so that a far one may be missed but the
/// answer never varies. Of arms with more than six joints, some of the many.
std::vector<JointVector> joints_reaching(const Chain& arm, const Eigen::Isometry3d& tool, const JointVector& reference);

/// Joints that the arm ends with when its tool moves from where it is at `from` straight to `tool`, turning evenly.
/// Nothing where it cannot follow, or passes so near to a singularity that joints would leap.
std::optional<JointVector> joints_after_line(const Chain& arm, const JointVector& from, const Eigen::Isometry3d& tool);

}  // namespace demecal
