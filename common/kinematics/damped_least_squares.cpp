#include "kinematics/damped_least_squares.hpp"

#include <Eigen/Cholesky>
#include <utility>

namespace demecal {
namespace {

constexpr double kSettled = 1e-13;      // rad or m, below what any joint resolves
constexpr double kSmallestStep = 1e-4;  // of the full step

/// Scales position rows to radians.
PoseError row_scales(const DampingOptions& options) {
  PoseError scales = PoseError::Ones();
  scales.head<3>() /= options.length_m;
  return scales;
}

/// A problem and how far from its start the joints are.
struct Search {
  const PoseFunction& model;
  const Eigen::Isometry3d& target;
  const JointVector& start;
  const DampingOptions& options;
  JointVector change;
  PoseAndJacobian at;
  double cost;
};

double cost_of(const Search& search, const PoseAndJacobian& at, const JointVector& change) {
  const PoseError error = row_scales(search.options).cwiseProduct(pose_error(at.pose, search.target));
  return error.squaredNorm() + search.options.damping * search.options.damping * change.squaredNorm();
}

/// The Gauss-Newton step.
JointVector step_of(const Search& search) {
  const PoseError scales = row_scales(search.options);
  const Eigen::MatrixXd jacobian = scales.asDiagonal() * search.at.jacobian;
  const PoseError error = scales.cwiseProduct(pose_error(search.at.pose, search.target));
  const double damping = search.options.damping * search.options.damping;
  Eigen::MatrixXd normal = jacobian.transpose() * jacobian;
  normal.diagonal().array() += damping;
  const Eigen::VectorXd downhill = jacobian.transpose() * error - damping * search.change;
  return normal.ldlt().solve(downhill);
}

/// Goes as much of the step, halved as often as needed, as lowers the cost; false if none of it does.
bool advance_along(const JointVector& step, Search& search) {
  for (double fraction = 1.0; fraction > kSmallestStep; fraction /= 2) {
    const JointVector change = search.change + fraction * step;
    PoseAndJacobian ahead = search.model(search.start + change);
    const double cost = cost_of(search, ahead, change);
    if (cost < search.cost) {
      search.change = change;
      search.at = std::move(ahead);
      search.cost = cost;
      return true;
    }
  }
  return false;
}

}  // namespace

JointVector damped_least_squares(const PoseFunction& model, const Eigen::Isometry3d& target, const JointVector& start,
                                 const DampingOptions& options) {
  Search search{model, target, start, options, JointVector::Zero(start.size()), model(start), 0.0};
  search.cost = cost_of(search, search.at, search.change);
  for (int iteration = 0; iteration < options.max_iterations; ++iteration) {
    const JointVector step = step_of(search);
    if (!step.allFinite() || step.norm() < kSettled || !advance_along(step, search)) break;
  }
  return start + search.change;
}

}  // namespace demecal
