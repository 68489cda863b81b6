#include "data_check/fitted_model.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "data_check/contradictions.hpp"
#include "data_check/instrument.hpp"
#include "data_check/single_poses.hpp"
#include "fitting/median.hpp"
#include "kinematics/units.hpp"

namespace demecal {
namespace {

constexpr double kMedianLength = 1.5382;  ///< median length of a vector of three standard normals

/// All poses stand in another frame than the model they are compared with.
Finding in_other_frame(const OtherSet& other) {
  return {
      .kind = FindingKind::set_in_other_frame,
      .as_given_mm = millimetres(other.as_given_m),
      .if_changed_mm = millimetres(other.if_changed_m),
      .sentence = fmt::format(
          "The data were measured in another frame than the model's: their points lie {} from where it puts them {}. "
          "`demecal evaluate --refit-base` fits base and tool to them first.",
          distance_text(other.shift_m), before_and_after(other.as_given_m, other.if_changed_m))};
}

}  // namespace

void check_fitted(const DataSet& data, const CorrectedRobot& robot, DataCheck& check) {
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
  if (errors.empty()) return;
  if (const auto other = find_other_frame(predicted, measured)) return check.findings.push_back(in_other_frame(*other));
  const double least_m = kNotableShare * Trial{data.robot.chain, {data.robot.chain.tool_m}, rows, 1}.reach_m();
  const double deviation_m = std::max(median(errors) / kMedianLength, 1e-6);
  const PointPrediction predict{point, [&](const TrialRow& row) { return error(row) / deviation_m; }};
  for (Finding& finding : find_single_poses(data, rows, predict, least_m)) check.findings.push_back(std::move(finding));
}

}  // namespace demecal
