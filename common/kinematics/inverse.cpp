#include "kinematics/inverse.hpp"

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <utility>

#include "decompositions/decompositions.hpp"
#include "kinematics/angles.hpp"
#include "kinematics/ended_inverse.hpp"

namespace demecal::inline kinematics {
namespace {

struct NewtonStep {
  JointVector dq;
  double smallest_singular = 0.0;
};

/// The pseudo-inverse step, undamped while the smallest singular value is above `singular_below`, and then damped the
/// more the closer it is to zero (Nakamura and Hanafusa, 1986), but by no more than the error itself (after Sugihara,
/// 2011): steps stay below about half a radian, and the damping fades as the target is neared. Lengths count in units
/// of `length_m`. A Jacobian that is not finite gives no step.
NewtonStep newton_step(const Jacobian& jacobian, const PoseError& error, const InverseOptions& options) {
  if (!jacobian.allFinite() || !error.allFinite()) return {JointVector::Zero(jacobian.cols()), 0.0};
  Jacobian scaled = jacobian;
  PoseError scaled_error = error;
  scaled.topRows<3>() /= options.length_m;
  scaled.leftCols(options.held).setZero();
  scaled_error.head<3>() /= options.length_m;
  const SingularSystem svd = singular_system(scaled, Eigen::ComputeThinU | Eigen::ComputeThinV);
  const Eigen::VectorXd& values = svd.values;
  const double smallest = values[values.size() - 1];
  const double damping = std::min(std::max(0.0, options.singular_below - smallest), scaled_error.norm());
  const Eigen::VectorXd gains = values.array() / (values.array().square() + damping * damping).max(1e-300);
  NewtonStep step{svd.v * gains.asDiagonal() * svd.u.transpose() * scaled_error, smallest};
  step.dq.head(options.held).setZero();
  return step;
}

bool within_tolerance(const PoseError& error, const InverseOptions& options) {
  return error.head<3>().norm() <= options.tolerance_m && error.tail<3>().norm() <= options.tolerance_rad;
}

double merit(const PoseError& error, const InverseOptions& options) {
  return error.head<3>().squaredNorm() / (options.length_m * options.length_m) + error.tail<3>().squaredNorm();
}

/// Where the iteration stands.
struct Iterate {
  JointVector q;
  PoseAndJacobian reached;
  PoseError error;
};

Iterate iterate_at(const PoseFunction& model, const Eigen::Isometry3d& target, const JointVector& q) {
  PoseAndJacobian reached = model(q);
  const PoseError error = pose_error(reached.pose, target);
  return {q, std::move(reached), error};
}

/// Tries the step, and halves of it as often as needed; false if `lowers_cost(fraction)` never holds.
template <typename LowersCost>
bool backtrack(const LowersCost& lowers_cost) {
  constexpr double kSmallestFraction = 1e-4;
  for (double fraction = 1.0; fraction > kSmallestFraction; fraction /= 2) {
    if (lowers_cost(fraction)) return true;
  }
  return false;
}

bool newton_advance(const JointVector& step, const PoseFunction& model, const Eigen::Isometry3d& target,
                    const InverseOptions& options, Iterate& iterate) {
  return backtrack([&](double fraction) {
    Iterate tried = iterate_at(model, target, iterate.q + fraction * step);
    if (!(merit(tried.error, options) < merit(iterate.error, options))) return false;
    iterate = std::move(tried);
    return true;
  });
}

constexpr double kSmallestStep = 1e-13;  // rad or m, below what any joint resolves

/// Scales position rows to radians.
PoseError row_scales(const DampingOptions& options) {
  PoseError scales = PoseError::Ones();
  scales.head<3>() /= options.length_m;
  return scales;
}

/// A problem and how far from its start the joints are.
struct DampedProblem {
  const PoseFunction& model;
  const Eigen::Isometry3d& target;
  const JointVector& start;
  const DampingOptions& options;
  JointVector change;
  PoseAndJacobian reached;
  double cost;
};

double damped_cost(const DampedProblem& problem, const PoseAndJacobian& reached, const JointVector& change) {
  const PoseError error = row_scales(problem.options).cwiseProduct(pose_error(reached.pose, problem.target));
  return error.squaredNorm() + problem.options.damping * problem.options.damping * change.squaredNorm();
}

JointVector gauss_newton_step(const DampedProblem& problem) {
  const PoseError scales = row_scales(problem.options);
  Eigen::MatrixXd jacobian = scales.asDiagonal() * problem.reached.jacobian;
  jacobian.leftCols(problem.options.held).setZero();
  const PoseError error = scales.cwiseProduct(pose_error(problem.reached.pose, problem.target));
  const double damping = problem.options.damping * problem.options.damping;
  Eigen::MatrixXd normal = jacobian.transpose() * jacobian;
  normal.diagonal().array() += damping;
  const Eigen::VectorXd downhill = jacobian.transpose() * error - damping * problem.change;
  return PivotedCholesky(normal).solve(downhill);
}

bool damped_advance(const JointVector& step, DampedProblem& problem) {
  return backtrack([&](double fraction) {
    const JointVector change = problem.change + fraction * step;
    PoseAndJacobian ahead = problem.model(problem.start + change);
    const double cost = damped_cost(problem, ahead, change);
    if (!(cost < problem.cost)) return false;
    problem.change = change;
    problem.reached = std::move(ahead);
    problem.cost = cost;
    return true;
  });
}

}  // namespace

PoseError pose_error(const Eigen::Isometry3d& pose, const Eigen::Isometry3d& target) {
  PoseError error;
  error << target.translation() - pose.translation(), rotation_between(pose.linear(), target.linear());
  return error;
}

InverseSolution inverse(const PoseFunction& model, const Eigen::Isometry3d& target, const JointVector& start,
                        const InverseOptions& options) {
  return inverse_unless([](const JointVector&) { return false; }, model, target, start, options);
}

InverseSolution inverse_unless(const std::function<bool(const JointVector&)>& ends_at, const PoseFunction& model,
                               const Eigen::Isometry3d& target, const JointVector& start,
                               const InverseOptions& options) {
  Iterate iterate = iterate_at(model, target, start);
  NewtonStep step = newton_step(iterate.reached.jacobian, iterate.error, options);
  const double smallest_singular = step.smallest_singular;
  bool ended = false;
  for (int iteration = 0; iteration < options.max_iterations && !within_tolerance(iterate.error, options);
       ++iteration) {
    if (iteration > 0) step = newton_step(iterate.reached.jacobian, iterate.error, options);
    if (!newton_advance(step.dq, model, target, options, iterate)) break;
    ended = ends_at(iterate.q);
    if (ended) break;
  }
  const bool singular = smallest_singular < options.singular_below;
  const InverseStatus status = ended                                             ? InverseStatus::diverged
                               : within_tolerance(iterate.error, options)        ? InverseStatus::converged
                               : !iterate.error.allFinite()                      ? InverseStatus::diverged
                               : singular || iterate.q.size() - options.held < 6 ? InverseStatus::damped
                                                                                 : InverseStatus::diverged;
  return {iterate.q, status, smallest_singular, iterate.error.head<3>().norm(), iterate.error.tail<3>().norm()};
}

JointVector damped_least_squares(const PoseFunction& model, const Eigen::Isometry3d& target, const JointVector& start,
                                 const DampingOptions& options) {
  DampedProblem problem{model, target, start, options, JointVector::Zero(start.size()), model(start), 0.0};
  problem.cost = damped_cost(problem, problem.reached, problem.change);
  for (int iteration = 0; iteration < options.max_iterations; ++iteration) {
    const JointVector step = gauss_newton_step(problem);
    if (!step.allFinite() || step.norm() < kSmallestStep || !damped_advance(step, problem)) break;
  }
  return start + problem.change;
}

}  // namespace demecal::inline kinematics
