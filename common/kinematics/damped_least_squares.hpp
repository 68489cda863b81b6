// Joints near given ones that come nearest to a pose which they cannot, or should not, reach exactly.
#pragma once

#include "kinematics/inverse.hpp"

namespace demecal {

struct DampingOptions {
  double length_m = 0.01;  ///< position error that counts as much as 1 rad: position comes first
  double damping = 0.02;   ///< orientation error, rad, that is accepted rather than move joints by 1 rad (or m)
  int max_iterations = 30;
};

/// The joints q that minimise |position error / length|^2 + |orientation error|^2 + |damping (q - start)|^2 (damped
/// least squares, Wampler, 1986). Unlike an inverse it is stable at singularities and defined for any number of joints:
/// what a lost direction asks for is left undone instead of being bought with large motions. Stops at the best joints
/// found.
JointVector damped_least_squares(const PoseFunction& model, const Eigen::Isometry3d& target, const JointVector& start,
                                 const DampingOptions& options = {});

}  // namespace demecal
