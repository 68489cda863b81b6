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

}  // namespace

void check_fitted(const DataSet& data, const CorrectedRobot& robot, DataCheck& check) {
  for (Finding& finding : implausible_links(data.robot.chain, robot.chain))
    check.findings.push_back(std::move(finding));
  std::set<std::string> named;
  for (const Finding& finding : check.findings) named.insert(finding.poses.begin(), finding.poses.end());
  std::vector<TrialRow> rows;
  for (std::size_t i = 0; i < data.poses.size(); ++i) {
    const MeasuredPose& pose = data.poses[i];
    if (pose.position_m && !named.contains(pose.pose_id)) rows.push_back({pose.joints, *pose.position_m, 0, 0, i});
  }
  const auto point = [&](const TrialRow& row) -> Eigen::Vector3d {
    const MeasuredPose& pose = data.poses[row.pose];
    return robot.predict(Stop(pose).with_joints(row.joints), pose.target).translation();
  };
  const auto error = [&](const TrialRow& row) { return (row.point_m - point(row)).norm(); };
  std::vector<Eigen::Vector3d> predicted, measured;
  std::vector<double> errors;
  for (const TrialRow& row : rows) {
    predicted.push_back(point(row));
    measured.push_back(row.point_m);
    errors.push_back(error(row));
  }
  for (Finding& finding : find_wrong_contacts(data, robot))
    if (finding.poses.empty() || !named.contains(finding.poses.front())) check.findings.push_back(std::move(finding));
  if (errors.empty()) return;
  // Of poses that stand in two frames already, none is the model's.
  if (const auto other =
          std::ranges::none_of(check.findings, moves_some_poses) ? find_other_frame(predicted, measured) : std::nullopt)
    return check.findings.push_back(in_other_frame(*other));
  const double least_m = kNotableShare * Trial{data.robot.chain, {data.robot.chain.tool_m}, rows, 1}.reach_m();
  const double deviation_m = std::max(median(errors) / normal_length_quantile(3, 0.5), 1e-6);
  const PointPrediction predict{point, [&](const TrialRow& row) { return error(row) / deviation_m; }};
  for (Finding& finding : find_single_poses(data, rows, predict, least_m)) check.findings.push_back(std::move(finding));
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
