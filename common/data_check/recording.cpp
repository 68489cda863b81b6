#include <fmt/format.h>
#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <functional>
#include <iterator>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "data/data_set.hpp"
#include "data/written_steps.hpp"
#include "data_check/searches.hpp"
#include "decompositions/decompositions.hpp"
#include "kinematics/chain.hpp"
#include "kinematics/units.hpp"
#include "trials/finding.hpp"
#include "trials/point_pairs.hpp"
#include "trials/projected_columns.hpp"
#include "trials/trial_fit.hpp"

namespace demecal::inline data_check {
namespace {

constexpr double kRoundingShare = 5e-5;        ///< of the reach, as arms repeat: rounding below it hides nothing
constexpr double kOfStep = 0.288675134594813;  ///< 1 / sqrt(12): the standard deviation of what rounding takes
constexpr std::size_t kFewestRounded = 20;

/// Both ends of how large errors are over what rounding alone leaves, where they may come from it.
bool as_rounded(double error, double rounded) {
  return error > 0.5 * rounded && error < 1.6 * rounded;
}

std::optional<Finding> coarse_positions(const Trial& trial) {
  constexpr std::string_view kAxes = "xyz";
  std::string columns;
  double coarsest_m = 0.0;
  for (Eigen::Index axis = 0; axis < 3; ++axis) {
    std::vector<double> values;
    for (const TrialRow& row : trial.rows) values.push_back(row.point_m[axis]);
    if (*std::ranges::max_element(values) - *std::ranges::min_element(values) < kRoundingShare) continue;
    const double step_m = decimal_step(values, metres(100.0));
    if (kOfStep * step_m < kRoundingShare * trial.reach_m()) continue;
    columns += fmt::format("{}{} to {:g} mm", columns.empty() ? "" : ", ", kAxes[static_cast<std::size_t>(axis)],
                           millimetres(step_m));
    coarsest_m = std::max(coarsest_m, step_m);
  }
  if (columns.empty()) return std::nullopt;
  return Finding{.kind = FindingKind::coarse_values,
                 .as_given_mm = millimetres(kOfStep * coarsest_m),
                 .sentence = fmt::format("Measured positions are rounded: {} only, {:.2g} mm off by that alone (rms). "
                                         "Take them from the instrument with all their digits.",
                                         columns, millimetres(kOfStep * coarsest_m))};
}

/// A joint's step in its own unit, and in words.
struct JointStep {
  double step = 0.0;
  std::string text;
};

JointStep written_joint(const Trial& trial, int joint) {
  std::vector<double> values;
  for (const TrialRow& row : trial.rows) values.push_back(row.joints[joint]);
  if (!is_revolute(trial.chain, joint)) {
    const double step = decimal_step(values, metres(10.0));
    return {step, fmt::format("{:g} mm", millimetres(step))};
  }
  const double by_degrees = decimal_step(values, radians(10.0)), by_radians = decimal_step(values, 1.0);
  return by_degrees >= by_radians ? JointStep{by_degrees, fmt::format("{:g} deg", degrees(by_degrees))}
                                  : JointStep{by_radians, fmt::format("{:g} rad", by_radians)};
}

/// A joint that is written far more coarsely than others, and errors that are as large along its motion as that makes
/// them and much smaller across it: values that were commanded to whole steps leave none.
std::optional<Finding> coarse_joint(const Trial& trial, const TrialFit& fit, int joint, const JointStep& written,
                                    double finest) {
  constexpr double kCoarser = 9.0, kAlongOverAcross = 1.5;
  if (written.step < kCoarser * finest) return std::nullopt;
  const Eigen::VectorXd column = joint_column(trial, fit, joint);
  double lever2 = 0.0, along2 = 0.0, across2 = 0.0, rows = 0.0;
  for (std::size_t i = 0; i < trial.rows.size(); ++i) {
    const Eigen::Vector3d lever = column.segment<3>(3 * static_cast<Eigen::Index>(i));
    const Eigen::Vector3d error = trial.rows[i].point_m - predicted_point(fit, trial.rows[i]);
    if (lever.squaredNorm() == 0.0 || fit.deviations_off(trial.rows[i]) > 5.0) continue;
    const double along = error.dot(lever) / lever.norm();
    lever2 += lever.squaredNorm();
    along2 += along * along;
    across2 += 0.5 * (error.squaredNorm() - along * along);
    rows += 1.0;
  }
  const double rounded_m = kOfStep * written.step * std::sqrt(lever2 / std::max(rows, 1.0));
  if (rows < static_cast<double>(kFewestRounded) || rounded_m < kRoundingShare * trial.reach_m() ||
      !as_rounded(std::sqrt(along2 / rows), rounded_m) || along2 < kAlongOverAcross * kAlongOverAcross * across2)
    return std::nullopt;
  return Finding{.kind = FindingKind::coarse_values,
                 .joint = joint,
                 .as_given_mm = millimetres(rounded_m),
                 .sentence = fmt::format(
                     "Joint {} is written to {} only, and points are off along its motion as that makes them: {:.2g} "
                     "mm (rms). Note it as finely as the other joints; such errors would be taken for the joint's.",
                     joint + 1, written.text, millimetres(rounded_m))};
}

/// All joints written so coarsely that errors may be no more than that. Pendants that show 0.01 deg are usual.
std::optional<Finding> coarse_joints(const Trial& trial, const TrialFit& fit, const std::vector<JointStep>& written) {
  constexpr double kNotableRounding = 2e-4;  // of the reach
  double squares_m2 = 0.0;
  for (int joint = 0; joint < trial.chain.size(); ++joint)
    squares_m2 += joint_column(trial, fit, joint).squaredNorm() *
                  std::pow(kOfStep * written[static_cast<std::size_t>(joint)].step, 2);
  const double rounded_m = std::sqrt(squares_m2 / static_cast<double>(trial.rows.size()));
  if (rounded_m < kNotableRounding * trial.reach_m() || !as_rounded(std::sqrt(3.0) * fit.deviation_m, rounded_m))
    return std::nullopt;
  const auto coarsest = std::ranges::max_element(written, {}, &JointStep::step);
  return Finding{
      .kind = FindingKind::coarse_values,
      .as_given_mm = millimetres(rounded_m),
      .sentence = fmt::format(
          "Joints are written to {} only. If they are what the controller showed and not what it was sent to, "
          "that alone puts points {:.2g} mm off (rms), most of what base, tool and links leave. Note joints "
          "to 0.001 deg.",
          coarsest->text, millimetres(rounded_m))};
}

/// Of each row the way that the joints came from the stop before; none of the first row.
std::vector<std::optional<JointVector>> last_ways(const DataSet& data, const Trial& trial, int direction) {
  std::vector<std::optional<JointVector>> ways;
  for (const TrialRow& row : trial.rows) {
    auto other = static_cast<std::ptrdiff_t>(row.pose);
    const auto inside = [&] { return other >= 0 && other < std::ssize(data.poses); };
    while (inside() && data.poses[static_cast<std::size_t>(other)].joints == data.poses[row.pose].joints)
      other += direction;
    ways.push_back(inside() ? std::optional<JointVector>(data.poses[row.pose].joints -
                                                         data.poses[static_cast<std::size_t>(other)].joints)
                            : std::nullopt);
  }
  return ways;
}

/// Columns of joints, each row's times `factor` of the row and joint.
template <typename Factor>
Eigen::MatrixXd by_joints(const Trial& trial, const TrialFit& fit, const Factor& factor) {
  Eigen::MatrixXd columns(3 * static_cast<Eigen::Index>(trial.rows.size()), trial.chain.size());
  for (int joint = 0; joint < trial.chain.size(); ++joint) {
    columns.col(joint) = joint_column(trial, fit, joint);
    for (Eigen::Index i = 0; i < columns.rows(); ++i)
      columns(i, joint) *= factor(static_cast<std::size_t>(i / 3), joint);
  }
  return columns;
}

constexpr double kGainOfRecording = 20.0;  ///< nats, for each row of a pose

/// A share of the way from the stop before that is missing in all joints alike: they were read before the arm stood.
/// Explains more than lost motion of each joint, a wrong gain of each, and the way to the stop behind.
std::optional<Finding> early_joints(const DataSet& data, const Trial& trial, const TrialFit& fit,
                                    const ProjectedColumns& projected) {
  constexpr double kFall = 0.85, kMostShare = 0.2;
  const auto before = last_ways(data, trial, -1), behind = last_ways(data, trial, 1);
  const auto way = [](const std::vector<std::optional<JointVector>>& ways) {
    return [&ways](std::size_t row, int joint) { return ways[row] ? (*ways[row])[joint] : 0.0; };
  };
  const Eigen::VectorXd late = by_joints(trial, fit, way(before)).rowwise().sum();
  const double gain = projected.gain(late), least = kGainOfRecording * fit.rows_per_pose;
  const double share = projected.coefficients(late)[0];
  if (gain < least || share <= 0.0 || share > kMostShare) return std::nullopt;
  const auto sign = [&before](std::size_t row, int joint) {
    const double moved = before[row] ? (*before[row])[joint] : 0.0;
    return moved > 0.0 ? 1.0 : moved < 0.0 ? -1.0 : 0.0;
  };
  const auto value = [&trial](std::size_t row, int joint) { return trial.rows[row].joints[joint]; };
  const double others =
      std::max({projected.gain(by_joints(trial, fit, sign)), projected.gain(by_joints(trial, fit, value)),
                projected.gain(by_joints(trial, fit, way(behind)).rowwise().sum())});
  if (gain < others + 0.5 * least) return std::nullopt;
  Trial stood = trial;
  for (std::size_t i = 0; i < stood.rows.size(); ++i)
    if (before[i]) stood.rows[i].joints += share * *before[i];
  const TrialFit changed = fit_arm(stood, fit_base_and_tools(stood));
  if (changed.median_m > kFall * fit.median_m) return std::nullopt;
  return Finding{.kind = FindingKind::early_joints,
                 .as_given_mm = millimetres(fit.median_m),
                 .if_changed_mm = millimetres(changed.median_m),
                 .sentence = fmt::format(
                     "Joints were read before the arm stood: {:.2g} % of every joint's way from the stop before was "
                     "still to come {}. Read them once the arm rests, and measure again; lost motion would be found "
                     "that the arm does not have.",
                     100.0 * share, before_and_after(fit.median_m, changed.median_m))};
}

/// The share of the variance of the rows' order that smooth functions of the joints explain.
double order_by_joints(const Trial& trial) {
  const auto n = static_cast<Eigen::Index>(trial.rows.size());
  Eigen::MatrixXd columns(n, 1 + 4 * trial.chain.size());
  Eigen::VectorXd order(n);
  for (Eigen::Index i = 0; i < n; ++i) {
    const JointVector& joints = trial.rows[static_cast<std::size_t>(i)].joints;
    order[i] = static_cast<double>(i) / static_cast<double>(n) - 0.5;
    columns(i, 0) = 1.0;
    for (int joint = 0; joint < trial.chain.size(); ++joint)
      columns.block<1, 4>(i, 1 + 4 * joint) << std::sin(joints[joint]), std::cos(joints[joint]),
          std::sin(2.0 * joints[joint]), std::cos(2.0 * joints[joint]);
  }
  Eigen::MatrixXd squares = columns.transpose() * columns;
  squares.diagonal().array() += 1e-9 * static_cast<double>(n);
  const Eigen::VectorXd with_order = columns.transpose() * order;
  const double explained = with_order.dot(PivotedCholesky(squares).solve(with_order)) / order.squaredNorm();
  // What as many columns of noise explain is none.
  const double chance = static_cast<double>(columns.cols()) / static_cast<double>(n);
  return std::max(0.0, (explained - chance) / std::max(1.0 - chance, 1e-3));
}

/// Points that wander with the order of rows, of data without times: from first to last, linear or settling.
std::optional<Finding> drift_without_times(const DataSet& data, const Trial& trial, const ProjectedColumns& projected,
                                           const TrialFit& fit) {
  constexpr double kMostByJoints = 0.3;  // beyond which errors of joints look like drift
  if (std::ranges::any_of(data.poses, [](const MeasuredPose& pose) { return pose.time_s.has_value(); }))
    return std::nullopt;
  if (order_by_joints(trial) > kMostByJoints) return std::nullopt;
  const auto n = static_cast<double>(trial.rows.size());
  double most = 0.0, wandered_m = 0.0;
  for (const double settling : {0.1, 0.3, 1e3}) {
    const double whole = -std::expm1(-1.0 / settling);
    Eigen::MatrixXd columns = Eigen::MatrixXd::Zero(3 * static_cast<Eigen::Index>(trial.rows.size()), 3);
    for (Eigen::Index i = 0; i < columns.rows(); ++i)
      columns(i, i % 3) = -std::expm1(-static_cast<double>(i / 3) / n / settling) / whole;
    const double gain = projected.gain(columns);
    if (gain <= most) continue;
    most = gain;
    wandered_m = projected.coefficients(columns).norm();
  }
  if (most < kGainOfRecording * fit.rows_per_pose) return std::nullopt;
  return Finding{.kind = FindingKind::drift_without_times,
                 .as_given_mm = millimetres(wandered_m),
                 .sentence = fmt::format(
                     "Points wander by {} from the first row to the last, with the order of rows and not with the "
                     "joints: the instrument, its stand or the temperature drifts. Note a time for every row (column "
                     "`time`), so that drift can be fitted, or let all warm up and measure again.",
                     distance_text(wandered_m))};
}

}  // namespace

std::vector<Finding> find_recording_errors(const DataSet& data, const Trial& trial, const TrialFit& fit) {
  std::vector<Finding> findings;
  if (trial.rows.size() < kFewestRounded) return findings;
  const auto add = [&findings](std::optional<Finding> finding) {
    if (finding) findings.push_back(std::move(*finding));
    return finding.has_value();
  };
  add(coarse_positions(trial));
  std::vector<JointStep> written;
  double finest = std::numeric_limits<double>::infinity();
  for (int joint = 0; joint < trial.chain.size(); ++joint) {
    written.push_back(written_joint(trial, joint));
    if (is_revolute(trial.chain, joint)) finest = std::min(finest, written.back().step);
  }
  bool one = false;
  for (int joint = 0; joint < trial.chain.size(); ++joint)
    one |= add(coarse_joint(trial, fit, joint, written[static_cast<std::size_t>(joint)], finest));
  if (!one) add(coarse_joints(trial, fit, written));
  if (!fit.has_links()) return findings;
  const ProjectedColumns projected(trial, fit);
  if (!add(early_joints(data, trial, fit, projected))) add(drift_without_times(data, trial, projected, fit));
  return findings;
}

}  // namespace demecal::inline data_check
