// Inverse kinematics by damped Newton steps from given joints, for any model whose pose and Jacobian can be computed.
#pragma once

#include <Eigen/Geometry>
#include <functional>

#include "kinematics/forward.hpp"

namespace demecal {

/// Pose of the tool (base frame) and its 6 x n Jacobian by the joint values, at given joint values.
struct PoseAndJacobian {
  Eigen::Isometry3d pose;
  Jacobian jacobian;
};
using PoseFunction = std::function<PoseAndJacobian(const JointVector&)>;

struct InverseOptions {
  double tolerance_m = 1e-10;    ///< position residual at which the solution is exact
  double tolerance_rad = 1e-10;  ///< orientation residual at which the solution is exact
  double length_m = 1.0;         ///< scale between metres and radians in singular values
  double singular_below = 0.02;  ///< smallest singular value under which steps are damped
  int max_iterations = 50;
};

enum class InverseStatus {
  converged,  ///< residual within tolerance
  damped,     ///< near a singularity the steps were damped, or the arm has too few joints: the residual remains
  diverged    ///< no solution was found from this start
};

struct InverseSolution {
  JointVector q;  ///< the best joints found
  InverseStatus status = InverseStatus::diverged;
  double smallest_singular = 0.0;  ///< of the scaled Jacobian at the start, rad: how far from singular the pose is
  double position_residual_m = 0.0;
  double orientation_residual_rad = 0.0;
};

/// Joints near `start` at which `model` reaches `target`. Newton with the pseudo-inverse, so that arms of 7 and more
/// joints take the least-norm step and arms with fewer than 6 the least-squares one; near a singularity the inverse is
/// damped (Nakamura and Hanafusa, 1986; Sugihara, 2011). Joint limits are the caller's. Never throws: what happened is
/// in the status.
InverseSolution inverse(const PoseFunction& model, const Eigen::Isometry3d& target, const JointVector& start,
                        const InverseOptions& options = {});

/// The rotation vector (rad, base frame) that takes `from` to `to`.
Eigen::Vector3d rotation_between(const Eigen::Matrix3d& from, const Eigen::Matrix3d& to);

/// What is missing from `pose` to `target`: linear (m), then angular (rad), in the frame both are given in.
using PoseError = Eigen::Matrix<double, 6, 1>;
PoseError pose_error(const Eigen::Isometry3d& pose, const Eigen::Isometry3d& target);

}  // namespace demecal
