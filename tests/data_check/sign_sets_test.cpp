// Joints of which several count the other way, and single columns in another unit: both are named, the described tool
// left as it is, and no frame of a controller is taken for a left-handed one.
#include "trials/sign_sets.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "data_check/pendant.hpp"
#include "elbow_arm.hpp"
#include "kinematics/forward.hpp"
#include "kinematics/random_arm.hpp"
#include "random/random_stream.hpp"
#include "trials/explanations.hpp"

namespace demecal {
namespace {

/// What a controller shows that counts as `factors` and then `zeros_deg` say.
DataSet shown(const std::vector<double>& factors, const std::vector<double>& zeros_deg, int poses = 16) {
  RandomStream stream{3303};
  DataSet data;
  data.robot.chain = elbow();
  data.frame = Frame::base;
  data.file = "pendant.csv";
  for (int i = 0; i < poses; ++i) {
    MeasuredPose pose;
    pose.joints = random_joints(stream, data.robot.chain);
    const Eigen::Vector3d point = forward(data.robot.chain, pose.joints) * data.robot.chain.tool_m;
    pose.position_m = point.unaryExpr([](double value) { return 1e-5 * std::round(value / 1e-5); });
    for (Eigen::Index joint = 0; joint < 6; ++joint) {
      const auto at = static_cast<std::size_t>(joint);
      pose.joints[joint] = (pose.joints[joint] - zeros_deg[at] * std::numbers::pi / 180.0) * factors[at];
    }
    pose.pose_id = std::to_string(i + 1);
    data.poses.push_back(std::move(pose));
  }
  return data;
}

const std::vector<double> kNoZeros(6, 0.0);

TEST(PendantSigns, SeveralAreNamedWithTheDescribedTool) {
  struct Case {
    std::vector<double> factors, zeros_deg;
    std::string clause;
  };
  for (const Case& one : {Case{{-1, 1, 1, -1, 1, -1}, kNoZeros, "joints 1, 4 and 6 are taken with the other sign."},
                          Case{{1, -1, -1, 1, -1, 1}, kNoZeros, "joints 2, 3 and 5 are taken with the other sign."},
                          Case{{-1, 1, 1, 1, 1, -1}, kNoZeros, "joints 1 and 6 are taken with the other sign."},
                          Case{{1, -1, -1, 1, -1, 1},
                               {0, -90, 90, 0, 0, 0},
                               "joints 2, 3 and 5 are taken with the other sign, and then -90 deg are added to joint 2 "
                               "and +90 deg are added to joint 3."}}) {
    const PendantComparison comparison = compare_with_pendant(shown(one.factors, one.zeros_deg));
    EXPECT_TRUE(comparison.explained) << one.clause;
    ASSERT_EQ(comparison.findings.size(), 1U) << ::testing::PrintToString(comparison.findings);
    EXPECT_EQ(comparison.findings.front(), "It fits if " + one.clause);
  }
}

TEST(PendantSigns, OthersThatFitAlikeAreListed) {
  // Joint 6 stands still, and the tool is off its axis: its sign moves no point.
  DataSet data = shown({1, -1, -1, 1, -1, 1}, kNoZeros);
  for (MeasuredPose& pose : data.poses) {
    JointVector joints = pose.joints;
    joints[5] = 0.0;
    pose.joints = joints;
    for (const Eigen::Index joint : {1, 2, 4}) joints[joint] *= -1.0;
    pose.position_m = forward(data.robot.chain, joints) * data.robot.chain.tool_m;
  }
  const PendantComparison comparison = compare_with_pendant(data);
  ASSERT_FALSE(comparison.findings.empty());
  EXPECT_EQ(comparison.findings[0], "It fits if joints 2, 3 and 5 are taken with the other sign.");
  EXPECT_TRUE(std::ranges::any_of(comparison.findings, [](const std::string& finding) {
    return finding.starts_with("Fits alike: joints 2, 3, 5 and 6 are taken with the other sign;");
  })) << ::testing::PrintToString(comparison.findings);
}

TEST(PendantSigns, AreSaidNotToBeTriedOfArmsWithManyJoints) {
  RandomStream stream{3305};
  DataSet data;
  data.robot.chain = elbow();
  for (int i = 0; i < 3; ++i) data.robot.chain.joints.push_back(elbow().joints[static_cast<std::size_t>(i)]);
  data.frame = Frame::base;
  for (int i = 0; i < 40; ++i) {
    MeasuredPose pose;
    pose.joints = random_joints(stream, data.robot.chain);
    pose.position_m = Eigen::Vector3d(stream.normal(), stream.normal(), stream.normal());
    pose.pose_id = std::to_string(i + 1);
    data.poses.push_back(std::move(pose));
  }
  const PendantComparison comparison = compare_with_pendant(data);
  ASSERT_EQ(comparison.findings.size(), 2U);
  EXPECT_TRUE(comparison.findings[1].starts_with("Signs of several joints at once were not tried"))
      << comparison.findings[1];
}

TEST(PendantSigns, AColumnInAnotherUnitIsNamed) {
  DataSet data = shown({1, 1, 1, 1, 1, 1}, kNoZeros);
  for (MeasuredPose& pose : data.poses) pose.position_m->x() *= 1e3;
  const PendantComparison comparison = compare_with_pendant(data);
  ASSERT_FALSE(comparison.findings.empty());
  EXPECT_EQ(comparison.findings.front(),
            "It fits if the column x of the positions alone is in millimetres where metres are stated.");
}

TEST(ExplanationSigns, StandBesideAMirroredFrameAndBeforeItWhereTheyKeepTheTool) {
  const DataSet data = shown({-1, 1, 1, -1, 1, -1}, kNoZeros, 30);
  Trial trial{data.robot.chain, {data.robot.chain.tool_m}, {}, 1};
  for (std::size_t i = 0; i < data.poses.size(); ++i)
    trial.rows.push_back({data.poses[i].joints, *data.poses[i].position_m, 0, 0, i});
  const auto best = best_explanation(trial, fit_base_and_tools(trial), 1e-3);
  ASSERT_TRUE(best);
  ASSERT_EQ(best->explanations.size(), 1U);
  EXPECT_EQ(best->explanations.front().clause, "joints 1, 4 and 6 are taken with the other sign");
  ASSERT_FALSE(best->equals.empty());
  EXPECT_EQ(best->equals.front().kind, FindingKind::mirrored);
}

}  // namespace
}  // namespace demecal
