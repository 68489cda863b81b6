#include <fmt/format.h>
#include <Eigen/Core>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <functional>
#include <iterator>
#include <numeric>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "data/data_set.hpp"
#include "data_check/searches.hpp"
#include "decompositions/decompositions.hpp"
#include "kinematics/chain.hpp"
#include "kinematics/units.hpp"
#include "trials/finding.hpp"
#include "trials/projected_columns.hpp"
#include "trials/trial_fit.hpp"

namespace demecal::inline data_check {
namespace {

/// Places of the poses in the order of measuring: of times where all have them, of the file otherwise.
std::vector<std::size_t> measured_order(const DataSet& data) {
  std::vector<std::size_t> order(data.poses.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  const auto time = [&](std::size_t pose) { return data.poses[pose].time_s.value_or(0.0); };
  if (std::ranges::all_of(data.poses, [](const MeasuredPose& pose) { return pose.time_s.has_value(); }))
    std::ranges::stable_sort(order, {}, time);
  return order;
}

/// What a share of the way from the stop before or to the one behind says.
struct WayMistake {
  int direction;  ///< -1: from the stop before; 1: to the one behind
  bool adds;      ///< joints of the row lack the share; otherwise they have it too much
  const char* what;
};
constexpr WayMistake kWayMistakes[] = {
    {-1, true,
     "Joints were read before the arm stood: {:.2g} % of every joint's way from the stop before was still to come {}. "
     "Read them once the arm rests, and measure again; "},
    {-1, false,
     "Points were measured before the arm stood: {:.2g} % of every joint's way from the stop before was still to come "
     "{}. Let it rest before the instrument reads, and measure again; "},
    {1, true,
     "Joints were read after the arm had left for the next stop, by {:.2g} % of every joint's way {}. Read them while "
     "it stands, and measure again; "},
    {1, false,
     "Points were measured after the arm had left for the next stop, by {:.2g} % of every joint's way {}. Measure "
     "while it stands; "},
};

/// A share of every joint's way that joints or points are off by, all joints alike. It explains more than lost motion
/// of each joint, a wrong gain of each, and the way on the other side of the stop.
std::optional<Finding> find_taken_in_motion(const DataSet& data, const Trial& trial, const TrialFit& fit,
                                            const ProjectedColumns& projected) {
  constexpr double kFall = 0.85, kMostShare = 0.2;
  const auto before = ways_of(data, trial, -1), behind = ways_of(data, trial, 1);
  const auto way = [](const std::vector<std::optional<JointVector>>& ways) {
    return [&ways](std::size_t row, int joint) { return ways[row] ? (*ways[row])[joint] : 0.0; };
  };
  const Eigen::VectorXd from = joint_columns(trial, fit, way(before)).rowwise().sum(),
                        to = joint_columns(trial, fit, way(behind)).rowwise().sum();
  const double gain_from = projected.gain(from), gain_to = projected.gain(to);
  const bool is_from = gain_from >= gain_to;
  const double gain = std::max(gain_from, gain_to), least = kNotableGain * fit.rows_per_pose;
  const double share = projected.coefficients(is_from ? from : to)[0];
  if (gain < least || std::abs(share) > kMostShare) return std::nullopt;
  const auto sign = [&before](std::size_t row, int joint) { return side_of(before[row], joint); };
  const auto value = [&trial](std::size_t row, int joint) { return trial.rows[row].joints[joint]; };
  const double others = std::max({projected.gain(joint_columns(trial, fit, sign)),
                                  projected.gain(joint_columns(trial, fit, value)), std::min(gain_from, gain_to)});
  if (gain < others + 0.5 * least) return std::nullopt;
  Trial stood = trial;
  for (std::size_t i = 0; i < stood.rows.size(); ++i)
    if (const auto& moved = is_from ? before[i] : behind[i]) stood.rows[i].joints += share * *moved;
  const TrialFit changed = fit_arm(stood, fit_base_and_tools(stood));
  if (changed.median_m > kFall * fit.median_m) return std::nullopt;
  const auto is_it = [&](const WayMistake& one) {
    return one.direction == (is_from ? -1 : 1) && one.adds == (share > 0.0);
  };
  const WayMistake& mistake = *std::ranges::find_if(kWayMistakes, is_it);
  return Finding{.kind = FindingKind::taken_in_motion,
                 .as_given_mm = millimetres(fit.median_m),
                 .if_changed_mm = millimetres(changed.median_m),
                 .sentence = fmt::format(fmt::runtime(mistake.what), 100.0 * std::abs(share),
                                         before_and_after(fit.median_m, changed.median_m)) +
                             "lost motion would be found that the arm does not have."};
}

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

/// The share of the variance of the rows' order that these explain.
double order_explained(const DataSet& data, const Trial& trial) {
  const auto n = static_cast<Eigen::Index>(trial.rows.size());
  Eigen::MatrixXd columns;
  Eigen::VectorXd order(n);
  for (Eigen::Index i = 0; i < n; ++i) {
    const TrialRow& row = trial.rows[static_cast<std::size_t>(i)];
    const std::vector<double> all = circumstances_of(data.poses[row.pose], row, trial.tools_m.size());
    if (i == 0) columns.resize(n, std::ssize(all));
    columns.row(i) = Eigen::Map<const Eigen::RowVectorXd>(all.data(), std::ssize(all));
    order[i] = static_cast<double>(i) / static_cast<double>(n) - 0.5;
  }
  const Eigen::VectorXd sizes = columns.colwise().norm().cwiseMax(1e-12);
  columns *= sizes.cwiseInverse().asDiagonal();
  Eigen::MatrixXd squares = columns.transpose() * columns;
  squares.diagonal().array() += 1e-9;
  const Eigen::VectorXd with_order = columns.transpose() * order;
  const double explained = with_order.dot(PivotedCholesky(squares).solve(with_order)) / order.squaredNorm();
  // What as many columns of noise explain is none.
  const double chance = static_cast<double>(columns.cols()) / static_cast<double>(n);
  return std::max(0.0, (explained - chance) / std::max(1.0 - chance, 1e-3));
}

/// Points that wander with the order of rows, of data without times: from first to last, linear or settling.
std::optional<Finding> drift_without_times(const DataSet& data, const Trial& trial, const ProjectedColumns& projected,
                                           const TrialFit& fit) {
  constexpr double kMostExplained = 0.3;  // beyond which what goes with the order looks like drift
  if (std::ranges::any_of(data.poses, [](const MeasuredPose& pose) { return pose.time_s.has_value(); }))
    return std::nullopt;
  if (order_explained(data, trial) > kMostExplained) return std::nullopt;
  const auto n = static_cast<double>(trial.rows.size());
  double most = 0.0, wandered_m = 0.0;
  Eigen::Vector3d middle = Eigen::Vector3d::Zero();
  for (const TrialRow& row : trial.rows) middle += row.point_m / n;
  for (const double settling : {0.1, 0.3, 1e3}) {
    const double whole = -std::expm1(-1.0 / settling);
    Eigen::MatrixXd columns = Eigen::MatrixXd::Zero(3 * static_cast<Eigen::Index>(trial.rows.size()), 6);
    for (std::size_t i = 0; i < trial.rows.size(); ++i) {
      const double share = -std::expm1(-static_cast<double>(i) / n / settling) / whole;
      auto rows = columns.middleRows<3>(3 * static_cast<Eigen::Index>(i));
      rows.leftCols<3>() = share * Eigen::Matrix3d::Identity();
      for (int axis = 0; axis < 3; ++axis)
        rows.col(3 + axis) = share * Eigen::Vector3d::Unit(axis).cross(trial.rows[i].point_m - middle);
    }
    const double gain = projected.gain(columns);
    if (gain <= most) continue;
    most = gain;
    const Eigen::VectorXd moved_m = columns * projected.coefficients(columns);
    wandered_m = 0.0;
    for (Eigen::Index i = 0; i < moved_m.size(); i += 3)
      wandered_m = std::max(wandered_m, moved_m.segment<3>(i).norm());
  }
  if (most < kNotableGain * fit.rows_per_pose) return std::nullopt;
  return Finding{
      .kind = FindingKind::drift_without_times,
      .as_given_mm = millimetres(wandered_m),
      .sentence = fmt::format(
          "Points wander by up to {} from the first row to the last, with the order of rows and not with the "
          "joints: the instrument, its stand or the temperature drifts. Note a time for every row (column "
          "`time`), so that drift can be fitted, or let all warm up and measure again.",
          distance_text(wandered_m))};
}

}  // namespace

std::vector<std::optional<JointVector>> ways_of(const DataSet& data, const Trial& trial, int direction) {
  constexpr double kSameStop = 2e-4;  // rad or m
  const std::vector<std::size_t> order = measured_order(data);
  std::vector<std::ptrdiff_t> place(order.size());
  for (std::size_t i = 0; i < order.size(); ++i) place[order[i]] = static_cast<std::ptrdiff_t>(i);
  std::vector<std::optional<JointVector>> ways;
  for (const TrialRow& row : trial.rows) {
    std::optional<JointVector> way;
    for (std::ptrdiff_t at = place[row.pose] + direction; !way && at >= 0 && at < std::ssize(order); at += direction) {
      const JointVector from = data.poses[row.pose].joints - data.poses[order[static_cast<std::size_t>(at)]].joints;
      if (from.cwiseAbs().maxCoeff() > kSameStop) way = from;
    }
    ways.push_back(way);
  }
  return ways;
}

double side_of(const std::optional<JointVector>& way, int joint) {
  const double moved = way ? (*way)[joint] : 0.0;
  return moved > 0.0 ? 1.0 : moved < 0.0 ? -1.0 : 0.0;
}

std::vector<Finding> find_recording_errors(const DataSet& data, const Trial& trial, const TrialFit& fit) {
  constexpr std::size_t kFewest = 20;
  std::vector<Finding> findings;
  if (trial.rows.size() < kFewest || !fit.has_links()) return findings;
  const ProjectedColumns projected(trial, fit);
  std::optional<Finding> finding = find_taken_in_motion(data, trial, fit, projected);
  if (!finding) finding = drift_without_times(data, trial, projected, fit);
  if (finding) findings.push_back(std::move(*finding));
  return findings;
}

}  // namespace demecal::inline data_check
