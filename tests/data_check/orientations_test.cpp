// Measured orientations that contradict the joints where positions alone say nothing: a point on the last axis.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <functional>

#include "data_check/check_data.hpp"
#include "kinematics/forward.hpp"
#include "kinematics/random_arm.hpp"

namespace demecal {
namespace {

using ::testing::HasSubstr;
using ::testing::IsEmpty;

/// Poses of an arm whose point lies on the last axis, the target turned on the flange, with 0.05 mm and 0.1 deg of
/// noise.
DataSet on_the_last_axis() {
  RandomStream stream{3411};
  DataSet data;
  data.file = "poses.csv";
  data.robot.chain = random_arm(stream, 6, Convention::modified_dh);
  data.robot.chain.flange = Eigen::Isometry3d::Identity();
  data.robot.chain.tool_m = {0.0, 0.0, 0.1};
  const Eigen::Quaterniond mounted(Eigen::AngleAxisd(1.1, Eigen::Vector3d(1.0, 2.0, -1.0).normalized()));
  Eigen::Isometry3d sensor_from_base(Eigen::AngleAxisd(0.7, Eigen::Vector3d(0.3, -0.2, 1.0).normalized()));
  sensor_from_base.translation() = Eigen::Vector3d(2.0, -1.0, 0.4);
  const auto noise = [&](double size) {
    return Eigen::Vector3d(size * stream.normal(), size * stream.normal(), size * stream.normal());
  };
  for (int i = 0; i < 40; ++i) {
    MeasuredPose pose;
    pose.joints = random_joints(stream, data.robot.chain);
    const Eigen::Isometry3d flange = sensor_from_base * forward(data.robot.chain, pose.joints);
    pose.position_m = flange * data.robot.chain.tool_m + noise(5e-5);
    const Eigen::Vector3d turn = noise(1.7e-3);
    pose.orientation = Eigen::Quaterniond(flange.linear()) * mounted *
                       Eigen::Quaterniond(Eigen::AngleAxisd(turn.norm(), turn.normalized()));
    pose.pose_id = std::to_string(i + 1);
    data.poses.push_back(std::move(pose));
  }
  return data;
}

Finding only_finding(const std::function<void(MeasuredPose&)>& mistake) {
  DataSet data = on_the_last_axis();
  for (MeasuredPose& pose : data.poses) mistake(pose);
  const DataCheck check = check_data(data);
  EXPECT_EQ(check.findings.size(), 1u);
  return check.findings.empty() ? Finding{} : check.findings.front();
}

TEST(WrongOrientations, AreNoneWhereTheyAgreeHoweverTheTargetIsMounted) {
  EXPECT_THAT(check_data(on_the_last_axis()).findings, IsEmpty());
}

TEST(WrongOrientations, AreNamedInFewRows) {
  for (const std::size_t wrong : {1u, 2u, 7u}) {
    DataSet data = on_the_last_axis();
    for (std::size_t i = 0; i < wrong; ++i) data.poses[2 * i].orientation = data.poses[2 * i].orientation->conjugate();
    const DataCheck check = check_data(data);
    ASSERT_EQ(check.findings.size(), 1u) << wrong;
    EXPECT_EQ(check.findings.front().kind, FindingKind::wrong_orientation);
    EXPECT_EQ(check.verdict(), DataVerdict::suspicious);
    ASSERT_EQ(check.findings.front().poses.size(), wrong);
    EXPECT_EQ(check.findings.front().poses.back(), data.poses[2 * (wrong - 1)].pose_id);
  }
}

TEST(WrongOrientations, TellTheSignOfAJointThatMovesNoPoint) {
  const Finding finding = only_finding([](MeasuredPose& pose) { pose.joints[5] = -pose.joints[5]; });
  EXPECT_EQ(finding.kind, FindingKind::joint_sign);
  EXPECT_EQ(finding.joint, 5);
  EXPECT_THAT(finding.sentence, HasSubstr("turn the sign of joint 6"));
}

TEST(WrongOrientations, TellTheOrderAndTheDirectionOfQuaternions) {
  const Finding order = only_finding([](MeasuredPose& pose) {
    const Eigen::Quaterniond q = *pose.orientation;
    pose.orientation = Eigen::Quaterniond(q.x(), q.y(), q.z(), q.w());
  });
  EXPECT_EQ(order.kind, FindingKind::convention);
  EXPECT_THAT(order.sentence, HasSubstr("read the columns of orientation as x, y, z, w."));
  const Finding direction = only_finding([](MeasuredPose& pose) { pose.orientation = pose.orientation->conjugate(); });
  EXPECT_EQ(direction.kind, FindingKind::convention);
  EXPECT_THAT(direction.sentence, HasSubstr("the other way round"));
}

TEST(WrongOrientations, ContradictTheJointsWhereNothingExplainsThem) {
  RandomStream stream{3412};
  const Finding finding = only_finding([&](MeasuredPose& pose) { pose.joints[5] = stream.real(-2.5, 2.5); });
  EXPECT_TRUE(contradicts(finding.kind));
  EXPECT_THAT(finding.sentence, HasSubstr("leave `orientation` out"));
}

}  // namespace
}  // namespace demecal
