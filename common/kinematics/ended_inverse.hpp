// Inverse kinematics that ends early where it is known what the rest of the search would find.
#pragma once

#include <functional>

#include "kinematics/inverse.hpp"

namespace demecal::inline kinematics {

/// As inverse(), but `ends_at` is asked where each step leads: true ends the search there, as diverged.
InverseSolution inverse_unless(const std::function<bool(const JointVector&)>& ends_at, const PoseFunction& model,
                               const Eigen::Isometry3d& target, const JointVector& start,
                               const InverseOptions& options = {});

}  // namespace demecal::inline kinematics
