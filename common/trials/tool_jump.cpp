#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>
#include <utility>
#include <vector>

#include "random/distributions.hpp"
#include "trials/drift.hpp"
#include "trials/explanations.hpp"
#include "trials/placed_rows.hpp"
#include "trials/point_pairs.hpp"
#include "trials/projected_columns.hpp"
#include "trials/trial_fit.hpp"

namespace demecal::inline trials {
namespace {

constexpr std::size_t kFewestWithTool = 5;  ///< rows of either tool
constexpr double kToolGain = 50.0;          ///< log likelihood that another tool must gain, for each row of a pose
constexpr double kToolGainBeyond = 25.0;    ///< the same beside drift and what files state
constexpr double kToolFall = 0.6;           ///< ratio of median errors: the fit has taken a part of the change
constexpr double kToolDeviations = 3.0;     ///< that points must jump by at the least
constexpr double kToolCap = 6.0;            ///< deviations beyond which an error says no more
constexpr int kToolRefits = 3;

/// How points move with each of the tools that change, three columns a tool.
Eigen::MatrixXd tool_columns(const Trial& trial, const TrialFit& fit, const std::vector<int>& tools) {
  Eigen::MatrixXd columns = Eigen::MatrixXd::Zero(3 * std::ssize(trial.rows), 3 * std::ssize(tools));
  const PlacedRows placed(fit.chain, trial.rows, false);
  TrialFit other = fit;
  for (std::size_t i = 0; i < trial.rows.size(); ++i) {
    const TrialRow& row = trial.rows[i];
    const auto tool = std::ranges::find(tools, row.target);
    if (tool == tools.end()) continue;
    const Eigen::Vector3d point = placed.point(fit, i, row);
    Eigen::Vector3d& moved = other.tools_m[static_cast<std::size_t>(row.target)];
    moved = fit.tools_m[static_cast<std::size_t>(row.target)];
    for (Eigen::Index axis = 0; axis < 3; ++axis) {
      moved[axis] += 1.0;
      columns.block<3, 1>(3 * static_cast<Eigen::Index>(i), 3 * (tool - tools.begin()) + axis) =
          placed.point(other, i, row) - point;
      moved[axis] -= 1.0;
    }
  }
  return columns;
}

Eigen::MatrixXd behind_row(const Eigen::MatrixXd& columns, std::size_t row) {
  Eigen::MatrixXd behind = columns;
  behind.topRows(3 * static_cast<Eigen::Index>(row)).setZero();
  return behind;
}

struct ToolStart {
  std::vector<int> tools;
  std::size_t row = 0;
  double gain = 0.0;
};

/// Rows from `begin` up to `end` that have one of the tools.
std::size_t rows_with(const Trial& trial, const std::vector<int>& tools, std::size_t begin, std::size_t end) {
  std::size_t count = 0;
  for (std::size_t i = begin; i < end; ++i) count += std::ranges::count(tools, trial.rows[i].target) > 0 ? 1 : 0;
  return count;
}

/// The row from which other tools gain most: a single one, or all at once.
ToolStart best_tool_start(const Trial& trial, const TrialFit& fit, const ProjectedColumns& projected) {
  std::vector<std::vector<int>> choices;
  std::vector<int> all;
  for (int tool = 0; tool < static_cast<int>(trial.tools_m.size()); ++tool) {
    choices.push_back({tool});
    all.push_back(tool);
  }
  if (all.size() > 1) choices.push_back(all);
  const std::size_t n = trial.rows.size();
  ToolStart best;
  double most = 0.0;
  for (const std::vector<int>& tools : choices) {
    const Eigen::MatrixXd columns = tool_columns(trial, fit, tools);
    const double cost = 1.5 * static_cast<double>(tools.size()) * std::log(3.0 * static_cast<double>(n));
    for (std::size_t row = kFewestWithTool; row + kFewestWithTool <= n; ++row) {
      if (std::ranges::count(tools, trial.rows[row].target) == 0) continue;
      if (std::min(rows_with(trial, tools, 0, row), rows_with(trial, tools, row, n)) < kFewestWithTool) continue;
      const double gain = projected.gain_beyond(behind_row(columns, row), Eigen::MatrixXd(columns.rows(), 0));
      if (gain - cost <= most) continue;
      most = gain - cost;
      best = {tools, row, gain};
    }
  }
  return best;
}

double capped_square_of(double error_m, double deviation_m) {
  const double off = std::min(error_m / deviation_m, kToolCap);
  return off * off;
}

double gained_by_tools(const std::vector<double>& before, const TrialFit& after) {
  double sum = 0.0;
  for (std::size_t i = 0; i < before.size(); ++i)
    sum +=
        0.5 * (capped_square_of(before[i], after.deviation_m) - capped_square_of(after.error_m[i], after.deviation_m));
  return sum;
}

int target_behind(int target, const std::vector<OtherTool>& other_tools) {
  const auto other = std::ranges::find(other_tools, target, &OtherTool::before);
  return other == other_tools.end() ? target : other->behind;
}

/// Rows from `row` on have tools of their own: those are numbered behind the others.
Trial with_other_tools(Trial trial, std::size_t row, const std::vector<OtherTool>& other_tools) {
  for (const OtherTool& other : other_tools)
    trial.tools_m.push_back(trial.tools_m[static_cast<std::size_t>(other.before)]);
  for (std::size_t i = row; i < trial.rows.size(); ++i)
    trial.rows[i].target = target_behind(trial.rows[i].target, other_tools);
  return trial;
}

/// The row from which the other tools fit better than the given ones, by a fit to both; as many as rows: none.
std::size_t best_tool_row(const Trial& trial, const TrialFit& both, const std::vector<OtherTool>& other_tools) {
  std::size_t best = trial.rows.size(), seen = 0;
  const PlacedRows placed(both.chain, trial.rows, false);
  double sum = 0.0, most = 0.0;
  for (std::size_t i = trial.rows.size(); i-- > 0;) {
    TrialRow row = trial.rows[i];
    const int other = target_behind(row.target, other_tools);
    if (other == row.target) continue;
    sum += capped_square_of((row.point_m - placed.point(both, i, row)).norm(), both.deviation_m);
    row.target = other;
    sum -= capped_square_of((row.point_m - placed.point(both, i, row)).norm(), both.deviation_m);
    if (++seen >= kFewestWithTool && sum > most) most = sum, best = i;
  }
  return best;
}

/// The most that drift of base and instrument gains, or of all joints, or of the tools that change.
double most_by_drift(const Trial& trial, const TrialFit& fit, const ProjectedColumns& projected,
                     const Eigen::MatrixXd& tools) {
  double most = 0.0;
  for (const DriftShape& shape : drift_shapes()) most = std::max(most, projected.gain(drift_columns(trial, shape)));
  const auto n = static_cast<double>(trial.rows.size());
  const Eigen::MatrixXd joints = joint_columns(trial, fit, [](std::size_t, int) { return 1.0; });
  for (const double settling : {0.1, 0.3, 1e3}) {
    Eigen::MatrixXd of_joints = joints, of_tools = tools;
    for (Eigen::Index i = 0; i < tools.rows(); ++i) {
      const double course = settling * -std::expm1(-static_cast<double>(i / 3) / n / settling);
      of_joints.row(i) *= course;
      of_tools.row(i) *= course;
    }
    most = std::max({most, projected.gain(of_joints), projected.gain(of_tools)});
  }
  return most;
}

/// The median error of the rows from `begin` up to `end` that have one of the tools.
double median_with(const Trial& trial, const std::vector<int>& tools, const std::vector<double>& errors,
                   std::size_t begin, std::size_t end) {
  std::vector<double> some;
  for (std::size_t i = begin; i < end; ++i)
    if (std::ranges::count(tools, trial.rows[i].target) > 0) some.push_back(errors[i]);
  return median(std::move(some));
}

/// Rows of one stop share what the arm errs by there: those that have one of the tools.
double rows_per_pose_with(Trial trial, const std::vector<int>& tools) {
  std::erase_if(trial.rows, [&](const TrialRow& row) { return std::ranges::count(tools, row.target) == 0; });
  return trial.rows_per_pose();
}

}  // namespace

std::optional<Jump> find_tool_jump(const Trial& trial, const TrialFit& fit) {
  const std::size_t n = trial.rows.size();
  if (n < 2 * kFewestWithTool + 2 || !fit.has_links()) return std::nullopt;
  const ProjectedColumns projected(trial, fit);
  const ToolStart start = best_tool_start(trial, fit, projected);
  if (start.gain < kToolGainBeyond) return std::nullopt;
  Jump jump{{.first_row = start.row}, trial, fit};
  for (const int tool : start.tools)
    jump.move.other_tools.push_back({tool, static_cast<int>(trial.tools_m.size() + jump.move.other_tools.size())});
  for (int i = 0; i < kToolRefits; ++i) {
    jump.trial = with_other_tools(trial, jump.move.first_row, jump.move.other_tools);
    jump.fit = fit_arm(jump.trial, fit_base_and_tools(jump.trial));
    if (!jump.fit.has_links()) return std::nullopt;
    const std::size_t row = best_tool_row(trial, jump.fit, jump.move.other_tools);
    if (row == jump.move.first_row) break;
    if (row == n || i + 1 == kToolRefits || rows_with(trial, start.tools, 0, row) < kFewestWithTool)
      return std::nullopt;
    jump.move.first_row = row;
  }
  const std::size_t row = jump.move.first_row;
  double squares = 0.0;
  for (const auto& [tool, other] : jump.move.other_tools)
    squares += (jump.fit.tools_m[static_cast<std::size_t>(other)] - jump.fit.tools_m[static_cast<std::size_t>(tool)])
                   .squaredNorm();
  jump.move.shift_m = std::sqrt(squares / static_cast<double>(start.tools.size()));
  jump.move.numbers = 3 * static_cast<int>(start.tools.size());
  const bool shorter_before = rows_with(trial, start.tools, 0, row) < rows_with(trial, start.tools, row, n);
  jump.move.as_given_m = std::max(median_with(trial, start.tools, fit.error_m, 0, row),
                                  median_with(trial, start.tools, fit.error_m, row, n));
  jump.move.if_changed_m =
      median_with(trial, start.tools, jump.fit.error_m, shorter_before ? 0 : row, shorter_before ? row : n);
  // In deviations of the better fit: those of the other hold the jump.
  const double sharper = std::pow(fit.deviation_m / jump.fit.deviation_m, 2);
  const double per_pose = rows_per_pose_with(trial, start.tools);
  const double least = kToolGain * per_pose, least_beyond = kToolGainBeyond * per_pose;
  const Eigen::MatrixXd columns = tool_columns(trial, fit, start.tools);
  if (gained_by_tools(fit.error_m, jump.fit) < least ||
      gained_by_tools(fit_arm_to_all(trial, fit).error_m, jump.fit) < least ||
      jump.move.shift_m < std::max(kToolDeviations * jump.fit.deviation_m, kSmallestShift_m) ||
      jump.move.if_changed_m > kToolFall * jump.move.as_given_m ||
      sharper * (start.gain - most_by_drift(trial, fit, projected, columns)) < least_beyond)
    return std::nullopt;
  if (jump.move.shift_m > most_by_conditions(trial) * trial.reach_m()) return jump;
  const Eigen::MatrixXd behind = behind_row(columns, start.row);
  if (sharper * projected.gain_beyond(behind, condition_columns(trial, fit)) < least_beyond) return std::nullopt;
  return jump;
}

}  // namespace demecal::inline trials
