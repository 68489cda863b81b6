#include "kinematics/inverse.hpp"

#include <Eigen/SVD>
#include <algorithm>
#include <cmath>
#include <utility>

namespace demecal {
namespace {

struct Step {
  JointVector dq;
  double smallest_singular = 0.0;
};

/// The pseudo-inverse step, undamped while the smallest singular value is above `singular_below`, and then damped the
/// more the closer it is to zero (Nakamura and Hanafusa, 1986), but by no more than the error itself (after Sugihara,
/// 2011): steps stay below about half a radian, and the damping fades as the target is neared. Lengths count in units
/// of `length_m`. A Jacobian that is not finite gives no step.
Step newton_step(const Jacobian& jacobian, const PoseError& error, const InverseOptions& options) {
  if (!jacobian.allFinite() || !error.allFinite()) return {JointVector::Zero(jacobian.cols()), 0.0};
  Jacobian scaled = jacobian;
  PoseError scaled_error = error;
  scaled.topRows<3>() /= options.length_m;
  scaled_error.head<3>() /= options.length_m;
  const Eigen::JacobiSVD<Eigen::MatrixXd> svd(scaled, Eigen::ComputeThinU | Eigen::ComputeThinV);
  const Eigen::VectorXd& values = svd.singularValues();
  const double smallest = values[values.size() - 1];
  const double damping = std::min(std::max(0.0, options.singular_below - smallest), scaled_error.norm());
  const Eigen::VectorXd gains = values.array() / (values.array().square() + damping * damping).max(1e-300);
  return {svd.matrixV() * gains.asDiagonal() * svd.matrixU().transpose() * scaled_error, smallest};
}

bool within(const PoseError& error, const InverseOptions& options) {
  return error.head<3>().norm() <= options.tolerance_m && error.tail<3>().norm() <= options.tolerance_rad;
}

double merit(const PoseError& error, const InverseOptions& options) {
  return error.head<3>().squaredNorm() / (options.length_m * options.length_m) + error.tail<3>().squaredNorm();
}

/// Where the iteration stands.
struct Iterate {
  JointVector q;
  PoseAndJacobian at;
  PoseError error;
};

Iterate iterate_at(const PoseFunction& model, const Eigen::Isometry3d& target, const JointVector& q) {
  PoseAndJacobian at = model(q);
  const PoseError error = pose_error(at.pose, target);
  return {q, std::move(at), error};
}

/// Goes as much of the step, halved as often as needed, as brings the target nearer; false if none of it does.
bool advance_along(const JointVector& dq, const PoseFunction& model, const Eigen::Isometry3d& target,
                   const InverseOptions& options, Iterate& iterate) {
  for (double fraction = 1.0; fraction > 1e-4; fraction /= 2) {
    Iterate tried = iterate_at(model, target, iterate.q + fraction * dq);
    if (merit(tried.error, options) < merit(iterate.error, options)) {
      iterate = std::move(tried);
      return true;
    }
  }
  return false;
}

}  // namespace

Eigen::Vector3d rotation_between(const Eigen::Matrix3d& from, const Eigen::Matrix3d& to) {
  // By way of the quaternion, which keeps all digits both of tiny rotations and near half a turn.
  const Eigen::AngleAxisd change(Eigen::Matrix3d(to * from.transpose()));
  return change.angle() * change.axis();
}

PoseError pose_error(const Eigen::Isometry3d& pose, const Eigen::Isometry3d& target) {
  PoseError error;
  error << target.translation() - pose.translation(), rotation_between(pose.linear(), target.linear());
  return error;
}

InverseSolution inverse(const PoseFunction& model, const Eigen::Isometry3d& target, const JointVector& start,
                        const InverseOptions& options) {
  Iterate iterate = iterate_at(model, target, start);
  Step step = newton_step(iterate.at.jacobian, iterate.error, options);
  const double smallest_singular = step.smallest_singular;
  for (int iteration = 0; iteration < options.max_iterations && !within(iterate.error, options); ++iteration) {
    if (!advance_along(step.dq, model, target, options, iterate)) break;
    step = newton_step(iterate.at.jacobian, iterate.error, options);
  }
  const bool singular = smallest_singular < options.singular_below;
  const InverseStatus status = within(iterate.error, options)     ? InverseStatus::converged
                               : !iterate.error.allFinite()       ? InverseStatus::diverged
                               : singular || iterate.q.size() < 6 ? InverseStatus::damped
                                                                  : InverseStatus::diverged;
  return {iterate.q, status, smallest_singular, iterate.error.head<3>().norm(), iterate.error.tail<3>().norm()};
}

}  // namespace demecal
