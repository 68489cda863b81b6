// A tool that is bent or changed during the measurement is named with its pose and size; what moves otherwise is not.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <cstdlib>
#include <functional>
#include <map>
#include <string>
#include <vector>

#include "data_check/check_data.hpp"
#include "kinematics/forward.hpp"
#include "kinematics/units.hpp"
#include "long_measurements.hpp"
#include "trials/trial_fit.hpp"

namespace demecal {
namespace {

std::string told_of_tools(const DataCheck& check) {
  std::string all;
  for (const Finding& finding : check.findings) all += finding.sentence + "\n";
  return all;
}

/// The poses of one of several targets.
DataSet of_target(DataSet data, const std::string& target) {
  std::erase_if(data.poses, [&](const MeasuredPose& pose) { return pose.target != target; });
  for (MeasuredPose& pose : data.poses) pose.target.clear();
  data.robot.chain.tool_m = data.tools_m.at(target);
  data.tools_m.clear();
  return data;
}

/// How the tool stands elsewhere in the flange's frame at a row.
using ToolShift = std::function<Eigen::Vector3d(std::size_t row)>;

DataSet with_tool_shifted(const DataSet& right, const ToolShift& shift_m) {
  std::map<std::string, int> target_of;
  Trial trial{right.robot.chain, {}, {}};
  for (const MeasuredPose& pose : right.poses) {
    const auto [target, is_new] = target_of.try_emplace(pose.target, static_cast<int>(trial.tools_m.size()));
    if (is_new) trial.tools_m.push_back(pose.target.empty() ? right.robot.chain.tool_m : right.tools_m.at(pose.target));
    trial.rows.push_back({pose.joints, *pose.position_m, target->second});
  }
  const Eigen::Matrix3d base = fit_base_and_tools(trial).sensor_from_base.front().linear();
  DataSet data = right;
  for (std::size_t i = 0; i < data.poses.size(); ++i)
    *data.poses[i].position_m += base * forward(data.robot.chain, data.poses[i].joints).linear() * shift_m(i);
  return data;
}

const Eigen::Vector3d kBent_m(4e-4, -3e-4, 3.5e-4);

DataSet with_tool_bent(const DataSet& right, std::size_t from) {
  return with_tool_shifted(right, [from](std::size_t row) { return row < from ? Eigen::Vector3d(0, 0, 0) : kBent_m; });
}

/// "... it stands 0.61 mm elsewhere on the flange ...", in metres.
double shift_told_m(const std::string& sentence) {
  const std::string before = "it stands ";
  const std::size_t at = sentence.find(before);
  return at == std::string::npos ? 0.0 : 1e-3 * std::atof(sentence.c_str() + at + before.size());
}

TEST(ToolJump, IsNamedWithItsPosesAndSize) {
  for (const DataSet& several : long_measurements(21)) {
    for (const DataSet& right : {several, of_target(several, "B")}) {
      const std::size_t from = 3 * right.poses.size() / 5 / 3 * 3;
      const DataSet data = with_tool_bent(right, from);
      const DataCheck check = check_data(data);
      const std::string of = data.robot.name + ", " + std::to_string(data.poses.size()) + ":\n" + told_of_tools(check);
      ASSERT_FALSE(check.findings.empty()) << of;
      const Finding& finding = check.findings.front();
      EXPECT_EQ(finding.kind, FindingKind::wrong_tool) << of;
      EXPECT_NEAR(static_cast<double>(finding.poses.size()), static_cast<double>(data.poses.size() - from), 3.0) << of;
      EXPECT_NEAR(shift_told_m(finding.sentence), kBent_m.norm(), 0.25 * kBent_m.norm()) << of;
      EXPECT_EQ(check.verdict(), DataVerdict::suspicious) << of;
    }
  }
}

TEST(ToolJump, OfOneOfSeveralTargetsIsNamedWithIt) {
  for (const DataSet& right : long_measurements(22)) {
    const std::size_t from = right.poses.size() / 2;
    const DataSet data = with_tool_shifted(right, [&](std::size_t row) {
      return Eigen::Vector3d((row >= from && right.poses[row].target == "B" ? 3.0 : 0.0) * kBent_m);
    });
    const DataCheck check = check_data(data);
    ASSERT_TRUE(check.has(FindingKind::wrong_tool)) << data.robot.name << '\n' << told_of_tools(check);
    EXPECT_THAT(check.findings.front().sentence, testing::HasSubstr("The tool point of target B changed"));
    EXPECT_NEAR(static_cast<double>(check.findings.front().poses.size()), static_cast<double>(from) / 3.0, 3.0);
  }
}

TEST(ToolJump, ATargetOfItsOwnIsWhatTheFindingAsksFor) {
  for (const DataSet& several : long_measurements(23)) {
    const DataSet right = of_target(several, "A");
    DataSet data = with_tool_bent(right, right.poses.size() / 2);
    for (std::size_t i = 0; i < data.poses.size(); ++i)
      data.poses[i].target = i < data.poses.size() / 2 ? "before" : "behind";
    data.tools_m["before"] = data.tools_m["behind"] = data.robot.chain.tool_m;
    EXPECT_TRUE(check_data(data).findings.empty()) << data.robot.name << '\n' << told_of_tools(check_data(data));
  }
}

TEST(ToolJump, AZeroOfTheLastJointIsToldAsEither) {
  for (const DataSet& several : long_measurements(24)) {
    DataSet data = of_target(several, "A");
    const Eigen::Index last = data.robot.chain.size() - 1;
    for (std::size_t i = data.poses.size() / 2; i < data.poses.size(); ++i) data.poses[i].joints[last] += radians(0.8);
    const DataCheck check = check_data(data);
    ASSERT_TRUE(check.has(FindingKind::joint_zero_changed)) << data.robot.name << '\n' << told_of_tools(check);
    EXPECT_FALSE(check.has(FindingKind::wrong_tool)) << data.robot.name;
    EXPECT_THAT(check.findings.front().sentence, testing::HasSubstr("or the tool turned about the axis of joint"));
    EXPECT_THAT(check.findings.front().sentence, testing::HasSubstr("do not tell it from a tool that stands"));
  }
}

TEST(ToolJump, AMoveOfTheInstrumentOrDriftIsNone) {
  for (const DataSet& several : long_measurements(25)) {
    const DataSet right = of_target(several, "A");
    const auto n = static_cast<double>(right.poses.size());
    DataSet moved = right;
    for (std::size_t i = right.poses.size() / 2; i < right.poses.size(); ++i)
      *moved.poses[i].position_m += Eigen::Vector3d(1e-3, -2e-3, 5e-4);
    EXPECT_FALSE(check_data(moved).has(FindingKind::wrong_tool)) << right.robot.name;
    EXPECT_TRUE(check_data(moved).has(FindingKind::instrument_moved)) << right.robot.name;
    for (const double settling : {0.1, 1e3}) {
      const double whole = -std::expm1(-1.0 / settling);
      const DataSet drifting = with_tool_shifted(right, [&](std::size_t row) -> Eigen::Vector3d {
        return kBent_m * (-std::expm1(-static_cast<double>(row) / n / settling) / whole);
      });
      EXPECT_FALSE(check_data(drifting).has(FindingKind::wrong_tool)) << right.robot.name << " " << settling;
    }
  }
}

}  // namespace
}  // namespace demecal
