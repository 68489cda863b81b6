// The corrected robot: what it predicts, its Jacobian, and commands that make it arrive where the nominal one would.
#include "prediction/corrected_robot.hpp"

#include <gtest/gtest.h>

#include "random_robot.hpp"

namespace demecal {
namespace {

double distance(const Eigen::Isometry3d& one, const Eigen::Isometry3d& other) {
  return pose_error(one, other).norm();
}

/// Joints of the wrist arm away from its elbow's and its wrist's singularities.
JointVector regular_joints(RandomStream& stream) {
  JointVector q = random_change(stream, 6, 1.5);
  q[2] = stream.real(-0.9, 0.9);
  q[4] = (stream.chance(0.5) ? 1.0 : -1.0) * stream.real(0.4, 1.4);
  return q;
}

TEST(CorrectedRobot, PredictsTheChainAtCorrectedJointsSeenByTheSensor) {
  RandomStream stream{601};
  for (int joints = 3; joints <= kMaxJoints; ++joints) {
    const CorrectedRobot robot =
        random_robot(stream, random_arm(stream, joints, Convention::standard_dh, 0.2), 0.01, 0.1);
    const JointVector q = random_joints(stream, robot.chain);
    JointVector actual = q;
    for (int i = 0; i < joints; ++i) actual[i] = q[i] + robot.corrections[static_cast<std::size_t>(i)](q[i]);
    EXPECT_EQ(robot.actual_joints(q), actual);
    for (const std::string target : {"", "B"}) {
      const Eigen::Matrix4d expected =
          robot.sensor_from_base.matrix() * forward(robot.chain, actual).matrix() * robot.tools.at(target).matrix();
      EXPECT_LT((robot.predict(q, target).matrix() - expected).norm(), 1e-13);
    }
  }
}

TEST(CorrectedRobot, HasTheJacobianOfItsPredictionsSlopesIncluded) {
  RandomStream stream{602};
  const double step = 1e-6;
  for (int joints = 3; joints <= kMaxJoints; ++joints) {
    const CorrectedRobot robot =
        random_robot(stream, mounted_arm(stream, joints, Convention::modified_dh, 0.2), 0.01, 0.2);
    const JointVector q = random_joints(stream, robot.chain);
    const PoseAndJacobian at = robot.predict_with_jacobian(q, "B");
    EXPECT_LT((at.pose.matrix() - robot.predict(q, "B").matrix()).norm(), 1e-13);
    ASSERT_EQ(at.jacobian.cols(), joints);
    for (int i = 0; i < joints; ++i) {
      JointVector ahead = q, behind = q;
      ahead[i] += step;
      behind[i] -= step;
      const PoseError expected = pose_error(robot.predict(behind, "B"), robot.predict(ahead, "B")) / (2 * step);
      EXPECT_LT((at.jacobian.col(i) - expected).norm(), 1e-8) << i;
    }
  }
}

TEST(CorrectedRobotDeathTest, RefusesTargetsItHasNoToolFor) {
  GTEST_FLAG_SET(death_test_style, "threadsafe");
  EXPECT_DEATH(CorrectedRobot().tool("C"), "no tool for target 'C'");
}

TEST(NominalRobot, IsTheChainItselfWithAToolForEveryTarget) {
  RandomStream stream{603};
  DataSet data;
  data.robot.chain = wrist_arm();
  data.tools_m = {{"A", {0.1, 0.0, 0.0}}, {"B", {0.0, 0.2, 0.0}}};
  const CorrectedRobot robot = nominal_robot(data);
  const JointVector q = random_joints(stream, data.robot.chain);
  const Eigen::Isometry3d flange = forward(data.robot.chain, q);
  EXPECT_TRUE(robot.predict(q, "").translation().isApprox(tool_position(data.robot.chain, q), 1e-15));
  EXPECT_TRUE(robot.predict(q, "A").translation().isApprox(flange * data.tools_m["A"], 1e-15));
  EXPECT_TRUE(robot.predict(q, "B").translation().isApprox(flange * data.tools_m["B"], 1e-15));
  EXPECT_EQ(robot.actual_joints(q), q);
  EXPECT_TRUE(robot.sensor_from_base.isApprox(Eigen::Isometry3d::Identity()));
}

TEST(CorrectedCommand, ClosesTheCircleOnGeometryErrorsAndCorrections) {
  RandomStream stream{604};
  const Chain nominal = wrist_arm();
  int regular = 0;
  for (int trial = 0; trial < 200; ++trial) {
    const CorrectedRobot robot = random_robot(stream, nominal, 2e-3, 0.01);
    const JointVector desired = regular_joints(stream);
    const Eigen::Isometry3d goal = robot.sensor_from_base * forward(nominal, desired) * robot.tool("");
    const InverseSolution command = corrected_command(robot, nominal, desired);
    if (command.smallest_singular < 0.1) continue;  // the wrist near the first axis, where its goal may be out of reach
    ++regular;
    EXPECT_EQ(command.status, InverseStatus::converged);
    EXPECT_LT(distance(robot.predict(command.q, ""), goal), 1e-9);
    EXPECT_GT(distance(robot.predict(desired, ""), goal), 1e-3);
  }
  EXPECT_GT(regular, 100);
}

TEST(CorrectedCommand, ClosesTheCircleWhereTheFirstOrderNegativeDoesNot) {
  RandomStream stream{605};
  const Chain nominal = wrist_arm();
  for (int trial = 0; trial < 100; ++trial) {
    CorrectedRobot robot = random_robot(stream, nominal, 0.0, 0.02);
    // A slope everywhere, so that g at the desired and g at the corrected joints differ.
    for (JointCorrection& correction : robot.corrections) {
      correction = JointCorrection(wave(0.02, 1.0, stream.real(-0.5, 0.5)), {}, {-4.0, 4.0});
    }
    const JointVector desired = regular_joints(stream) / 3 + JointVector::Constant(6, 0.3);
    const Eigen::Isometry3d goal = robot.sensor_from_base * forward(nominal, desired) * robot.tool("");
    const JointVector negative = desired - (robot.actual_joints(desired) - desired);
    const InverseSolution command = corrected_command(robot, nominal, desired);
    EXPECT_GT(distance(robot.predict(negative, ""), goal), 1e-6);
    EXPECT_LT(distance(robot.predict(command.q, ""), goal), 1e-9);
    EXPECT_LT((robot.actual_joints(command.q) - desired).norm(), 1e-8);
  }
}

TEST(CorrectedCommand, OfARobotWithoutErrorsIsTheDesiredOne) {
  DataSet data;
  data.robot.chain = wrist_arm();
  RandomStream stream{606};
  const JointVector desired = regular_joints(stream);
  EXPECT_EQ(corrected_command(nominal_robot(data), data.robot.chain, desired).q, desired);
}

TEST(CorrectedCommand, AtASingularWristMendsThePositionAndSaysWhatRemains) {
  RandomStream stream{607};
  const Chain nominal = wrist_arm();
  for (int trial = 0; trial < 50; ++trial) {
    const CorrectedRobot robot = random_robot(stream, nominal, 1e-3, 0.005);
    JointVector desired = regular_joints(stream);
    desired[1] = stream.real(-0.2, 0.3);
    desired[4] = 0.0;
    const Eigen::Isometry3d goal = robot.sensor_from_base * forward(nominal, desired) * robot.tool("");
    const InverseSolution command = corrected_command(robot, nominal, desired);
    const PoseError left = pose_error(robot.predict(command.q, ""), goal);
    EXPECT_LT(left.head<3>().norm(), 5e-5);
    EXPECT_LT((command.q - desired).cwiseAbs().maxCoeff(), 0.51);
    EXPECT_EQ(command.status == InverseStatus::converged, left.norm() < 1e-9);
    EXPECT_NEAR(command.position_residual_m, left.head<3>().norm(), 1e-12);
    EXPECT_NEAR(command.orientation_residual_rad, left.tail<3>().norm(), 1e-12);
  }
}

TEST(CorrectedCommand, OfFewerThanSixJointsPutsThePositionFirst) {
  RandomStream stream{608};
  for (const int joints : {4, 5}) {
    int regular = 0;
    for (int trial = 0; trial < 200; ++trial) {
      const Chain nominal = random_arm(stream, joints, Convention::standard_dh);
      const CorrectedRobot robot = random_robot(stream, nominal, 2e-3, 0.01);
      const JointVector desired = random_joints(stream, nominal);
      const Eigen::Isometry3d goal = robot.sensor_from_base * forward(nominal, desired) * robot.tool("");
      const InverseSolution command = corrected_command(robot, nominal, desired);
      if (command.smallest_singular < 0.15) continue;
      ++regular;
      const double before_m = (robot.predict(desired, "").translation() - goal.translation()).norm();
      EXPECT_EQ(command.status, InverseStatus::damped);
      EXPECT_LT(command.position_residual_m, 0.1 * before_m);
    }
    EXPECT_GT(regular, 20);
  }
}

TEST(NominalRobot, KnowsWhichPayloadsAndTemperaturesItIsToBeCalibratedWith) {
  DataSet data;
  data.robot.chain = wrist_arm();
  data.poses.resize(3);
  EXPECT_FALSE(nominal_robot(data).payloads_kg);
  data.poses[1].payload_kg = 4.0;
  data.poses[2].payload_kg = 1.5;
  EXPECT_EQ(nominal_robot(data).payloads_kg, (Interval{1.5, 4.0}));
  EXPECT_FALSE(nominal_robot(data).temperatures_celsius);
  data.poses[0].temperature_celsius = 24.0;
  data.poses[2].temperature_celsius = 19.5;
  EXPECT_EQ(nominal_robot(data).temperatures_celsius, (Interval{19.5, 24.0}));
}

}  // namespace
}  // namespace demecal
