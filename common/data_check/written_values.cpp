#include <fmt/format.h>
#include <Eigen/Core>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <functional>
#include <limits>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "data/contacts.hpp"
#include "data/data_set.hpp"
#include "data/written_steps.hpp"
#include "data_check/searches.hpp"
#include "kinematics/chain.hpp"
#include "kinematics/units.hpp"
#include "prediction/contact_place.hpp"
#include "prediction/corrected_robot.hpp"
#include "prediction/measurement.hpp"
#include "prediction/only_places.hpp"
#include "random/distributions.hpp"
#include "trials/finding.hpp"
#include "trials/projected_columns.hpp"
#include "trials/trial_fit.hpp"

namespace demecal::inline data_check {
namespace {

constexpr double kComputedShare = 1e-5;      ///< of the reach, which no instrument and no arm keeps
constexpr double kMostRoundingShare = 8e-5;  ///< of the reach: coarser rounding could hide the errors of a good arm
constexpr double kOverRounding = 1.0;        ///< median error over the root mean square of rounding
constexpr double kFewestPosesTold = 12.0;    ///< different ones, below which base and tool explain too much

constexpr double kRoundingShare = 5e-5;        ///< of the reach, as arms repeat: rounding below it hides nothing
constexpr double kOfStep = 0.288675134594813;  ///< 1 / sqrt(12): the standard deviation of what rounding takes
constexpr std::size_t kFewestRounded = 20;

/// Both ends of how large errors are over what rounding alone leaves, where they may come from it.
bool as_rounded(double error, double rounded) {
  return error > 0.5 * rounded && error < 1.6 * rounded;
}

std::optional<Finding> coarse_positions(const Trial& trial) {
  constexpr std::string_view kAxes = "xyz";
  constexpr double kOnePlace_m = 5e-5;
  std::string columns;
  double coarsest_m = 0.0;
  for (Eigen::Index axis = 0; axis < 3; ++axis) {
    std::vector<double> values;
    for (const TrialRow& row : trial.rows) values.push_back(row.point_m[axis]);
    if (*std::ranges::max_element(values) - *std::ranges::min_element(values) < kOnePlace_m) continue;
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
  return Finding{
      .kind = FindingKind::coarse_values,
      .joint = joint,
      .as_given_mm = millimetres(rounded_m),
      .sentence = fmt::format("Joint {} is written to {} only. If that is what the controller showed and not what it "
                              "was sent to, points are off along its motion as that makes them: {:.2g} mm (rms). Note "
                              "it as finely as the other joints; such errors would be taken for the joint's.",
                              joint + 1, written.text, millimetres(rounded_m))};
}

/// All joints written so coarsely that errors may be no more than that. Pendants that show 0.01 deg are usual.
std::optional<Finding> coarse_joints(const Trial& trial, const TrialFit& fit, const std::vector<JointStep>& written,
                                     double finest) {
  constexpr double kNotableRounding = 2e-4;  // of the reach
  double squares_m2 = 0.0;
  const JointStep* coarsest = nullptr;
  for (int joint = 0; joint < trial.chain.size(); ++joint) {
    const JointStep& one = written[static_cast<std::size_t>(joint)];
    // A joint may have been sent to round values only.
    const double step = is_revolute(trial.chain, joint) ? finest : one.step;
    squares_m2 += joint_column(trial, fit, joint).squaredNorm() * std::pow(kOfStep * step, 2);
    if (one.step == step && step > 0.0 && coarsest == nullptr) coarsest = &one;
  }
  const double rounded_m = std::sqrt(squares_m2 / static_cast<double>(trial.rows.size()));
  if (coarsest == nullptr || rounded_m < kNotableRounding * trial.reach_m() ||
      !as_rounded(std::sqrt(3.0) * fit.deviation_m, rounded_m))
    return std::nullopt;
  return Finding{
      .kind = FindingKind::coarse_values,
      .as_given_mm = millimetres(rounded_m),
      .sentence = fmt::format(
          "Joints are written to {} only. If they are what the controller showed and not what it was sent to, that "
          "alone puts points {:.2g} mm off (rms), as much as base, tool and links leave. Note joints to 0.001 deg.",
          coarsest->text, millimetres(rounded_m))};
}

/// Whether errors follow the joint's position or side, as those of gears, springs and lost motion do and rounding does
/// not.
bool follows_joint(const DataSet& data, const Trial& trial, const TrialFit& fit, const ProjectedColumns& projected,
                   const std::vector<std::optional<JointVector>>& ways, int joint) {
  const Eigen::VectorXd column = joint_column(trial, fit, joint);
  Eigen::MatrixXd waves(column.size(), 6), sides(column.size(), 2);
  for (Eigen::Index i = 0; i < column.size(); ++i) {
    const TrialRow& row = trial.rows[static_cast<std::size_t>(i / 3)];
    const MeasuredPose& pose = data.poses[row.pose];
    for (int order = 1; order <= 3; ++order) {
      waves(i, 2 * order - 2) = column[i] * std::sin(order * row.joints[joint]);
      waves(i, 2 * order - 1) = column[i] * std::cos(order * row.joints[joint]);
    }
    sides(i, 0) = column[i] * side_of(ways[static_cast<std::size_t>(i / 3)], joint);
    sides(i, 1) = column[i] * (pose.approach ? (*pose.approach)[joint] : 0.0);
  }
  const double least = 2.0 * kNotableGain * fit.rows_per_pose;  // rounding scatters points along the joint's way alone
  return projected.gain(waves) > least || projected.gain(sides) > least;
}

/// The error that rounding to the table's last places alone leaves, root mean square.
double rounding_m(const Trial& trial, const TrialFit& placed) {
  std::vector<double> positions;
  std::vector<JointVector> joints;
  for (const TrialRow& row : trial.rows) {
    positions.insert(positions.end(), row.point_m.begin(), row.point_m.end());
    joints.push_back(row.joints);
  }
  const JointSteps steps = joint_steps(trial.chain, joints);
  const double position_m = decimal_step(positions, metres(1.0));
  double squares = 0.0;
  for (const TrialRow& row : trial.rows)
    squares += position_m * position_m / 4.0 +
               rounding_m2(placed.chain, row.joints, placed.tools_m[static_cast<std::size_t>(row.target)], steps);
  return std::sqrt(squares / static_cast<double>(trial.rows.size()));
}

}  // namespace

std::optional<Finding> find_computed_positions(const Trial& trial, const TrialFit& placed) {
  if (static_cast<double>(trial.rows.size()) < kFewestPosesTold * placed.rows_per_pose) return std::nullopt;
  const double reach_m = trial.reach_m(), rounded_m = rounding_m(trial, placed);
  const bool by_rounding = rounded_m < kMostRoundingShare * reach_m && placed.median_m < kOverRounding * rounded_m;
  if (!by_rounding && placed.median_m > kComputedShare * reach_m) return std::nullopt;
  return Finding{.kind = FindingKind::computed_positions,
                 .as_given_mm = millimetres(placed.median_m),
                 .sentence = fmt::format(
                     "With base and tool alone the nominal arm reaches half of the points to within {:.2g} mm{}: these "
                     "are positions that the controller (or a simulation) computed from the joints, not measured ones. "
                     "Measure the points with an instrument: computed ones say nothing about the arm.",
                     std::max(millimetres(placed.median_m), 1e-4),
                     by_rounding ? ", the rounding of the file" : ", as no arm does")};
}

std::vector<Finding> find_coarse_values(const DataSet& data, const Trial& trial, const TrialFit& fit) {
  std::vector<Finding> findings;
  if (trial.rows.size() < kFewestRounded) return findings;
  if (auto positions = coarse_positions(trial)) findings.push_back(std::move(*positions));
  std::vector<JointStep> written;
  std::vector<bool> follows(static_cast<std::size_t>(trial.chain.size()), false);
  double finest = std::numeric_limits<double>::infinity();
  const auto ways = ways_of(data, trial, -1);
  const auto projected = fit.has_links() ? std::optional<ProjectedColumns>(std::in_place, trial, fit) : std::nullopt;
  for (int joint = 0; joint < trial.chain.size(); ++joint) {
    written.push_back(written_joint(trial, joint));
    if (is_revolute(trial.chain, joint)) finest = std::min(finest, written.back().step);
    if (projected) follows[static_cast<std::size_t>(joint)] = follows_joint(data, trial, fit, *projected, ways, joint);
  }
  const std::size_t before = findings.size();
  for (int joint = 0; joint < trial.chain.size(); ++joint) {
    const auto place = static_cast<std::size_t>(joint);
    if (follows[place]) continue;
    if (auto one = coarse_joint(trial, fit, joint, written[place], finest)) findings.push_back(std::move(*one));
  }
  if (findings.size() > before || std::ranges::count(follows, true) > 0) return findings;
  if (auto all = coarse_joints(trial, fit, written, finest)) findings.push_back(std::move(*all));
  return findings;
}

std::optional<Finding> find_computed_contacts(const DataSet& data, const CorrectedRobot& stiff) {
  constexpr std::size_t kFewestPosesTouching = 12;  ///< besides those that only place a contact
  constexpr double kComputedTouch = 2e-5;           ///< of the reach, to which plans reach contacts and no arm does
  std::vector<JointVector> joints;
  std::vector<std::size_t> told;
  double reach_m = 0.1;
  for (const auto& [group, members] : contact_groups(data)) {
    if (only_places(data.contacts.form_of(group.contact), members.size())) continue;
    told.insert(told.end(), members.begin(), members.end());
  }
  for (const std::size_t pose : told) {
    joints.push_back(data.poses[pose].joints);
    reach_m = std::max(reach_m, touch_of(stiff, data.poses[pose]).point_m.norm());
  }
  if (told.size() < kFewestPosesTouching) return std::nullopt;
  const JointSteps steps = joint_steps(stiff.chain, joints);
  double squares_m2 = 0.0;
  for (const std::size_t pose : told)
    squares_m2 +=
        rounding_m2(stiff.chain, data.poses[pose].joints, stiff.tool(data.poses[pose].target).translation(), steps);
  const double rounded_m = std::sqrt(squares_m2 / static_cast<double>(told.size()));
  const double left_m = median(tool_errors_m(stiff, data, told));
  const bool by_rounding = rounded_m < kMostRoundingShare * reach_m && left_m < kOverRounding * rounded_m;
  if (!by_rounding && left_m > kComputedTouch * reach_m) return std::nullopt;
  return Finding{
      .kind = FindingKind::computed_positions,
      .as_given_mm = millimetres(left_m),
      .sentence = fmt::format("With its tool alone fitted the nominal arm holds half of the poses to within {:.2g} mm "
                              "of what they touch{}: these are joint values that a plan (or a simulation) computed, "
                              "not those of an arm that touched something. Replace them by what the controller shows "
                              "once the tool is seated: computed ones say nothing about the arm.",
                              std::max(millimetres(left_m), 1e-4),
                              by_rounding ? ", the rounding of the file" : ", as no arm does")};
}

}  // namespace demecal::inline data_check
