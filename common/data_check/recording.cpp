#include <fmt/format.h>
#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <optional>
#include <utility>
#include <vector>

#include "data/data_set.hpp"
#include "data_check/searches.hpp"
#include "decompositions/decompositions.hpp"
#include "kinematics/chain.hpp"
#include "kinematics/units.hpp"
#include "trials/drift.hpp"
#include "trials/finding.hpp"
#include "trials/projected_columns.hpp"
#include "trials/trial_fit.hpp"

namespace demecal::inline data_check {
namespace {

/// What the rows' order may go with that the file states: smooth functions of the joints, sides of approach, payload,
/// temperature, targets.
std::vector<double> circumstances_of(const MeasuredPose& pose, const TrialRow& row, std::size_t targets) {
  std::vector<double> all{1.0, pose.payload_kg.value_or(0.0), pose.temperature_celsius.value_or(0.0)};
  for (const double joint : row.joints)
    all.insert(all.end(), {std::sin(joint), std::cos(joint), std::sin(2.0 * joint), std::cos(2.0 * joint)});
  for (Eigen::Index joint = 0; joint < row.joints.size(); ++joint)
    all.push_back(pose.approach ? (*pose.approach)[joint] : 0.0);
  for (std::size_t target = 1; target < targets; ++target)
    all.push_back(static_cast<std::size_t>(row.target) == target ? 1.0 : 0.0);
  return all;
}

/// What each row's circumstances hold, one column each of unit length.
Eigen::MatrixXd circumstance_columns(const DataSet& data, const Trial& trial) {
  const auto n = static_cast<Eigen::Index>(trial.rows.size());
  Eigen::MatrixXd columns;
  for (Eigen::Index i = 0; i < n; ++i) {
    const TrialRow& row = trial.rows[static_cast<std::size_t>(i)];
    const std::vector<double> all = circumstances_of(data.poses[row.pose], row, trial.tools_m.size());
    if (i == 0) columns.resize(n, std::ssize(all));
    columns.row(i) = Eigen::Map<const Eigen::RowVectorXd>(all.data(), std::ssize(all));
  }
  const Eigen::VectorXd sizes = columns.colwise().norm().cwiseMax(1e-12);
  columns *= sizes.cwiseInverse().asDiagonal();
  return columns;
}

/// Shares of the variance of what goes with the rows' order that their circumstances explain.
class ExplainedOrder {
 public:
  explicit ExplainedOrder(Eigen::MatrixXd columns) : columns_(std::move(columns)) {
    Eigen::MatrixXd squares = columns_.transpose() * columns_;
    squares.diagonal().array() += 1e-9;
    factor_ = PivotedCholesky(squares);
  }

  double share_of(Eigen::VectorXd course) const {
    course.array() -= course.mean();
    const Eigen::VectorXd with_course = columns_.transpose() * course;
    const double explained = with_course.dot(factor_.solve(with_course)) / course.squaredNorm();
    // What as many columns of noise explain is none.
    const double chance = static_cast<double>(columns_.cols()) / static_cast<double>(columns_.rows());
    return std::max(0.0, (explained - chance) / std::max(1.0 - chance, 1e-3));
  }

 private:
  Eigen::MatrixXd columns_;
  PivotedCholesky factor_;
};

struct Wandering {
  double gain = 0.0, farthest_m = 0.0;
  bool returns = false;
};

/// The shape by which the points wander most clearly, of those that do not go with the rows' circumstances, as none may
/// where the order itself does; what more numbers gain counts less their price of half a logarithm of the coordinates
/// each.
Wandering best_wandering(const DataSet& data, const Trial& trial, const ProjectedColumns& projected) {
  constexpr double kMostExplained = 0.3;  // beyond which what goes with the order looks like drift
  const ExplainedOrder explained(circumstance_columns(data, trial));
  const auto goes_along = [&](const DriftCourse& course) {
    return explained.share_of(along(trial, course)) > kMostExplained;
  };
  Wandering best;
  if (goes_along([](double share) { return share; })) return best;
  for (const DriftShape& shape : drift_shapes()) {
    if (std::ranges::any_of(shape.courses, goes_along)) continue;
    const Eigen::MatrixXd columns = drift_columns(trial, shape);
    const double price =
        0.5 * static_cast<double>(columns.cols() - 6) * std::log(3.0 * static_cast<double>(trial.rows.size()));
    const double gain = projected.gain(columns) - price;
    if (gain <= best.gain) continue;
    best = {gain, 0.0, shape.returns};
    const Eigen::VectorXd moved_m = columns * projected.coefficients(columns);
    for (Eigen::Index i = 0; i < moved_m.size(); i += 3)
      best.farthest_m = std::max(best.farthest_m, moved_m.segment<3>(i).norm());
  }
  return best;
}

/// The largest gain of one joint that counts too much or too little, by which random rows seem to wander too.
double gain_of_one_joint(const Trial& trial, const TrialFit& fit, const ProjectedColumns& projected) {
  const Eigen::MatrixXd columns =
      joint_columns(trial, fit, [&trial](std::size_t row, int joint) { return trial.rows[row].joints[joint]; });
  double gain = 0.0;
  for (Eigen::Index joint = 0; joint < columns.cols(); ++joint)
    gain = std::max(gain, projected.gain(columns.col(joint)));
  return gain;
}

}  // namespace

std::optional<Finding> find_drift_without_times(const DataSet& data, const Trial& trial, const TrialFit& fit) {
  if (trial.rows.size() < kFewestRecorded || !fit.has_links()) return std::nullopt;
  if (std::ranges::any_of(data.poses, [](const MeasuredPose& pose) { return pose.time_s.has_value(); }))
    return std::nullopt;
  const ProjectedColumns projected(trial, fit);
  const Wandering wandering = best_wandering(data, trial, projected);
  if (wandering.gain < std::max(kNotableGain * fit.rows_per_pose, gain_of_one_joint(trial, fit, projected)))
    return std::nullopt;
  return Finding{
      .kind = FindingKind::drift_without_times,
      .as_given_mm = millimetres(wandering.farthest_m),
      .sentence = fmt::format(
          "Points wander by up to {} {}, with the order of rows and not with the joints: the instrument, its stand or "
          "the temperature drifts. Note a time for every row (column `time`), so that drift can be fitted, or let all "
          "warm up and measure again.",
          distance_text(wandering.farthest_m),
          wandering.returns ? "there and back" : "from the first row to the last")};
}

}  // namespace demecal::inline data_check
