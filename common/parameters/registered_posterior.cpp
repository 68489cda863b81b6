#include <Eigen/Core>
#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

#include "decompositions/decompositions.hpp"
#include "effects/arm_state.hpp"
#include "parameters/posterior.hpp"
#include "prediction/measurement.hpp"

namespace demecal::inline parameters {
namespace {

// Along what the poses do not show at all, as wide as undetermined numbers of a model: tools by a hundredth, bases by
// what a person could not overlook.
constexpr double kToolBefore_m = 0.01, kToolBefore_rad = 0.1, kBaseBefore = 1.0;

double deviation_before(const ParameterId& id) {
  if (id.is_of_base()) return kBaseBefore;
  return id.kind == ParameterId::Kind::tool_translation ? kToolBefore_m : kToolBefore_rad;
}

/// Of a pose's measured point and distances: how they move with each number of `unit`, over their standard deviations.
/// What touches something says nothing of base and tool.
Eigen::MatrixXd weighed_rows(const Posterior& unit, const PredictionInterval& interval, const CorrectedRobot& robot,
                             const DataSet& data, const MeasuredPose& pose) {
  const MeasurementRows counts = rows_of(pose);
  const Stop stop(pose);
  const auto by_motion = measurement_jacobian(robot, robot.predict(stop, pose.target), data, pose);
  Eigen::MatrixXd rows(counts.position + counts.distances, unit.factor.cols());
  const auto spread = pose_spread(unit, robot, stop, pose.target);
  const auto over = [&](double noise_m) { return 1.0 / std::hypot(noise_m, interval.model_error_m); };
  rows.topRows(counts.position) = over(interval.noise_m) * by_motion.topRows(counts.position) * spread;
  rows.bottomRows(counts.distances) = over(interval.distance_noise_m) * by_motion.bottomRows(counts.distances) * spread;
  return rows;
}

}  // namespace

Posterior registered_posterior(const Posterior& posterior, const PredictionInterval& interval,
                               const CorrectedRobot& registered, const DataSet& data,
                               std::span<const std::size_t> poses) {
  const Posterior arm = posterior.without([](const ParameterId& id) { return id.is_of_base() || id.is_of_tool(); });
  const std::vector<ParameterId> placed = free_parameters(data, {.registration = true, .tool = true});
  const auto fitted = static_cast<Eigen::Index>(placed.size()), known = arm.factor.rows();
  Posterior unit{placed, arm.terms, Eigen::MatrixXd::Identity(fitted + known, fitted + known)};
  unit.ids.insert(unit.ids.end(), arm.ids.begin(), arm.ids.end());
  Eigen::MatrixXd square = Eigen::MatrixXd::Zero(fitted, fitted), beside = Eigen::MatrixXd::Zero(fitted, known);
  for (Eigen::Index i = 0; i < fitted; ++i)
    square(i, i) = std::pow(deviation_before(placed[static_cast<std::size_t>(i)]), -2);
  for (const std::size_t pose : poses) {
    const Eigen::MatrixXd rows = weighed_rows(unit, interval, registered, data, data.poses[pose]);
    square += rows.leftCols(fitted).transpose() * rows.leftCols(fitted);
    beside += rows.leftCols(fitted).transpose() * rows.rightCols(known);
  }
  // square = L L^T: its inverse is L^-T L^-1. Base and tool make up for what the arm's numbers are wrong by.
  const Cholesky solver(square);
  unit.factor = Eigen::MatrixXd::Zero(fitted + known, arm.factor.cols() + fitted);
  unit.factor.topLeftCorner(fitted, arm.factor.cols()) = -solver.solve(beside * arm.factor);
  unit.factor.topRightCorner(fitted, fitted) = solver.whitened(Eigen::MatrixXd::Identity(fitted, fitted)).transpose();
  unit.factor.bottomLeftCorner(known, arm.factor.cols()) = arm.factor;
  return unit;
}

}  // namespace demecal::inline parameters
