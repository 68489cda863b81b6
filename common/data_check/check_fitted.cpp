#include <fmt/format.h>
#include <Eigen/Core>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <functional>
#include <iterator>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "data/contacts.hpp"
#include "data/data_set.hpp"
#include "data_check/check_data.hpp"
#include "data_check/searches.hpp"
#include "effects/arm_state.hpp"
#include "kinematics/chain.hpp"
#include "kinematics/units.hpp"
#include "parameters/declared_model.hpp"
#include "parameters/posterior.hpp"
#include "pieces/pieces.hpp"
#include "prediction/corrected_robot.hpp"
#include "random/distributions.hpp"
#include "trials/explanations.hpp"
#include "trials/finding.hpp"
#include "trials/trial_fit.hpp"

namespace demecal::inline data_check {
namespace {

/// All poses stand in another frame than the model they are compared with.
Finding in_other_frame(const OtherSet& other) {
  return {
      .kind = FindingKind::set_in_other_frame,
      .as_given_mm = millimetres(other.as_given_m),
      .if_changed_mm = millimetres(other.if_changed_m),
      .sentence = fmt::format(
          "The data were measured in another frame than the model's: their points lie {} from where it puts them {}. "
          "`demecal evaluate --refit-base` fits base and tool to them first, and so does a fit whose `model.declared` "
          "has "
          "registration.",
          distance_text(other.shift_m), before_and_after(other.as_given_m, other.if_changed_m))};
}

/// Whether the finding says that some poses stand otherwise than the others.
bool moves_some_poses(const Finding& finding) {
  return finding.kind == FindingKind::instrument_moved || finding.kind == FindingKind::joint_zero_changed ||
         finding.kind == FindingKind::set_in_other_frame || finding.kind == FindingKind::wrong_tool;
}

/// A finding for each joint of which the fitted link is farther from its description than three times what makers'
/// figures are usually wrong by.
std::vector<Finding> implausible_links(const Chain& described, const Chain& fitted) {
  constexpr double kMost = 3.0;
  struct Part {
    LinkParameter parameter;
    const char* name;
    bool angle;
  };
  constexpr Part kParts[] = {{LinkParameter::theta, "theta", true},
                             {LinkParameter::d, "d", false},
                             {LinkParameter::a, "a", false},
                             {LinkParameter::alpha, "alpha", true}};
  std::vector<Finding> findings;
  for (int joint = 0; joint < described.size(); ++joint) {
    const auto place = static_cast<std::size_t>(joint);
    std::string parts;
    for (const Part& part : kParts) {
      const double before = described.joints[place].parameter(part.parameter);
      const double after = fitted.joints[place].parameter(part.parameter);
      if (std::abs(after - before) < kMost * (part.angle ? kMakersDeviation_rad : kMakersDeviation_m)) continue;
      parts += (parts.empty() ? "" : ", ") +
               (part.angle ? fmt::format("{} {:.2f} instead of {:.2f} deg", part.name, degrees(after), degrees(before))
                           : fmt::format("{} {:.1f} instead of {:.1f} mm", part.name, millimetres(after),
                                         millimetres(before)));
    }
    if (parts.empty()) continue;
    findings.push_back({.kind = FindingKind::implausible_link, .joint = joint});
    findings.back().sentence = fmt::format(
        "Joint {} and its link are fitted far from the robot's description: {}. Makers' figures are right to some 5 mm "
        "and 1 "
        "deg: check the file against the arm, the joint's zero, and lengths that the data state.",
        joint + 1, parts);
  }
  return findings;
}

/// A fitted model beside the points that were measured.
class FittedArm {
 public:
  FittedArm(const DataSet& data, const CorrectedRobot& robot) : data_(data), robot_(robot) {}

  std::vector<TrialRow> rows(const std::function<bool(const MeasuredPose&)>& wanted) const {
    std::vector<TrialRow> rows;
    for (std::size_t i = 0; i < data_.poses.size(); ++i) {
      const MeasuredPose& pose = data_.poses[i];
      if (pose.position_m && wanted(pose)) rows.push_back({pose.joints, *pose.position_m, 0, 0, i});
    }
    return rows;
  }

  Eigen::Vector3d point(const TrialRow& row) const {
    const MeasuredPose& pose = data_.poses[row.pose];
    return robot_.predict(Stop(pose).with_joints(row.joints), pose.target).translation();
  }

  std::vector<double> errors_m(const std::vector<TrialRow>& rows) const {
    std::vector<double> errors(rows.size());
    in_batches(rows.size(), [&](std::size_t i) { errors[i] = error_m(rows[i]); });
    return errors;
  }

  /// Those of the rows, not none, that are off alone.
  std::vector<Finding> single_poses(const std::vector<TrialRow>& rows) const {
    const Chain& chain = data_.robot.chain;
    const double least_m = kNotableShare * Trial{chain, {chain.tool_m}, rows, 1}.reach_m();
    const double deviation_m = std::max(median(errors_m(rows)) / normal_length_quantile(3, 0.5), 1e-6);
    const PointPrediction predict{[this](const TrialRow& row) { return point(row); },
                                  [&](const TrialRow& row) { return error_m(row) / deviation_m; }};
    return find_single_poses(data_, rows, predict, least_m);
  }

 private:
  double error_m(const TrialRow& row) const { return (row.point_m - point(row)).norm(); }

  const DataSet& data_;
  const CorrectedRobot& robot_;
};

/// Takes back what was said of single poses and of whole sets before there was a model that explains them: elasticity
/// makes outliers of the most telling poses, and drift another frame of the last set.
void withdraw_explained(const FittedArm& arm, std::vector<Finding>& findings) {
  constexpr double kAlike = 2.0;  ///< ratio of median errors up to which a set is as the others are
  const std::vector<TrialRow> all = arm.rows([](const MeasuredPose&) { return true; });
  if (all.empty()) return;
  std::set<std::string> off;
  for (const Finding& finding : arm.single_poses(all)) off.insert(finding.poses.begin(), finding.poses.end());
  std::erase_if(findings, [&](const Finding& finding) {
    const std::set<std::string> own(finding.poses.begin(), finding.poses.end());
    const auto is_own = [&](const MeasuredPose& pose) { return own.contains(pose.pose_id); };
    const std::vector<TrialRow> inside = arm.rows(is_own), outside = arm.rows(std::not_fn(is_own));
    if (inside.empty() || outside.empty()) return false;
    if (finding.kind == FindingKind::outlier || finding.kind == FindingKind::typing_error)
      return std::ranges::none_of(finding.poses, [&](const std::string& id) { return off.contains(id); });
    return (finding.kind == FindingKind::set_in_other_frame || finding.kind == FindingKind::wrong_tool) &&
           median(arm.errors_m(inside)) < kAlike * median(arm.errors_m(outside));
  });
}

}  // namespace

void check_fitted(const DataSet& data, const CorrectedRobot& robot, DataCheck& check) {
  for (Finding& finding : implausible_links(data.robot.chain, robot.chain))
    check.findings.push_back(std::move(finding));
  const FittedArm arm(data, robot);
  withdraw_explained(arm, check.findings);
  std::set<std::string> named;
  for (const Finding& finding : check.findings) named.insert(finding.poses.begin(), finding.poses.end());
  const std::vector<TrialRow> rows = arm.rows([&](const MeasuredPose& pose) { return !named.contains(pose.pose_id); });
  for (Finding& finding : find_wrong_contacts(data, robot))
    if (finding.poses.empty() || !named.contains(finding.poses.front())) check.findings.push_back(std::move(finding));
  if (rows.empty()) return;
  // Of poses that stand in two frames already, none is the model's.
  if (std::ranges::none_of(check.findings, moves_some_poses)) {
    std::vector<Eigen::Vector3d> predicted, measured;
    for (const TrialRow& row : rows) {
      predicted.push_back(arm.point(row));
      measured.push_back(row.point_m);
    }
    if (const auto other = find_other_frame(predicted, measured))
      return check.findings.push_back(in_other_frame(*other));
  }
  std::ranges::move(arm.single_poses(rows), std::back_inserter(check.findings));
}

void check_fitted(const DataSet& data, const CorrectedRobot& robot, const std::optional<Posterior>& posterior,
                  const std::optional<PredictionInterval>& interval, DataCheck& check) {
  check_fitted(data, robot, check);
  if (!posterior || !interval || data.contacts.distances.empty()) return;
  std::set<std::string> named;
  for (const Finding& finding : check.findings) named.insert(finding.poses.begin(), finding.poses.end());
  DataSet rest = data;  // poses that are named already may hold a contact elsewhere
  std::erase_if(rest.poses, [&](const MeasuredPose& pose) { return named.contains(pose.pose_id); });
  std::vector<Finding> lengths = find_disagreeing_lengths(rest, robot, *posterior, *interval);
  // Lengths that contradict one another tell no scale.
  if (lengths.empty())
    if (auto factor = find_common_factor(rest, robot, *posterior)) lengths.push_back(std::move(*factor));
  std::ranges::move(lengths, std::back_inserter(check.findings));
}

}  // namespace demecal::inline data_check
