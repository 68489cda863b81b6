// Inverse kinematics of any model whose pose and Jacobian can be computed: exact by damped Newton steps, or nearest by
// damped least squares.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <functional>

#include "kinematics/angles.hpp"
#include "kinematics/chain.hpp"
#include "kinematics/forward.hpp"

namespace demecal::inline kinematics {

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
  int held = 0;  ///< so many joints, from the base on, stay where the start has them
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

/// What is missing from `pose` to `target`: linear (m), then angular (rad), in the frame both are given in.
using PoseError = Eigen::Matrix<double, 6, 1>;
PoseError pose_error(const Eigen::Isometry3d& pose, const Eigen::Isometry3d& target);

struct DampingOptions {
  double length_m = 0.01;  ///< position error that counts as much as 1 rad: position comes first
  double damping = 0.02;   ///< orientation error, rad, that is accepted rather than move joints by 1 rad (or m)
  int max_iterations = 30;
  int held = 0;  ///< as InverseOptions::held
};

/// The joints q that minimise |position error / length|^2 + |orientation error|^2 + |damping (q - start)|^2 (damped
/// least squares, Wampler, 1986). Unlike an inverse it is stable at singularities and defined for any number of joints:
/// what a lost direction asks for is left undone instead of being bought with large motions. Stops at the best joints
/// found.
JointVector damped_least_squares(const PoseFunction& model, const Eigen::Isometry3d& target, const JointVector& start,
                                 const DampingOptions& options = {});

}  // namespace demecal::inline kinematics
