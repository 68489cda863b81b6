// Of an arm whose axes are parallel, what moves along them is the same of base, lift and tool: one of them is named.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <string>

#include "kinematics/units.hpp"
#include "lacking_numbers.hpp"
#include "parameters/declared_model.hpp"
#include "updating/change.hpp"

namespace demecal {
namespace {

Robot scara_robot() {
  Robot robot;
  robot.name = "scara";
  robot.chain.convention = Convention::standard_dh;
  robot.chain.joints.resize(4);
  Joint& arm = robot.chain.joints[0];
  arm.a_m = 0.325;
  arm.d_m = 0.34;
  Joint& forearm = robot.chain.joints[1];
  forearm.a_m = 0.275;
  forearm.alpha_rad = radians(180.0);
  robot.chain.joints[2].type = JointType::prismatic;
  robot.chain.joints[3].d_m = 0.05;
  const double limits_deg[] = {130.0, 145.0, 0.0, 355.0};
  for (std::size_t i = 0; i < 4; ++i) {
    robot.chain.joints[i].upper = radians(limits_deg[i]);
    robot.chain.joints[i].lower = -robot.chain.joints[i].upper;
  }
  robot.chain.joints[2].upper = 0.2;
  robot.chain.tool_m = {0.03, 0.01, 0.04};
  return robot;
}

CorrectedRobot true_scara(std::uint64_t seed) {
  RandomStream random{9310, seed};
  DataSet data;
  data.robot = scara_robot();
  CorrectedRobot truth = nominal_robot(data);
  for (Joint& joint : truth.chain.joints) {
    joint.theta_rad += 1.4e-3 * random.normal();
    joint.alpha_rad += 7e-4 * random.normal();
    joint.a_m += 3e-4 * random.normal();
    joint.d_m += 3e-4 * random.normal();
  }
  truth.sensor_from_base = Eigen::AngleAxisd(1.9, Eigen::Vector3d(0.04, -0.05, 1.0).normalized());
  truth.sensor_from_base.translation() = Eigen::Vector3d(1.5, -0.6, 0.4);
  return truth;
}

DataSet measured_scara(const CorrectedRobot& truth, int calibration, int validation, std::uint64_t draw) {
  constexpr double kNoise_m = 5e-5;
  RandomStream random{9311, draw};
  DataSet data;
  data.robot = scara_robot();
  data.file = data.name = "scara";
  for (int i = 0; i < calibration + validation; ++i) {
    MeasuredPose pose;
    pose.joints = random_joints(random, data.robot.chain);
    pose.set = i < calibration ? PoseSet::calibration : PoseSet::validation;
    pose.pose_id = std::to_string(i);
    pose.approach = ApproachSigns::Ones(4);
    for (double& side : *pose.approach) side = random.chance(0.5) ? 1.0 : -1.0;
    pose.position_m = truth.predict(pose.joints, "").translation() +
                      kNoise_m * Eigen::Vector3d(random.normal(), random.normal(), random.normal());
    data.poses.push_back(pose);
  }
  return data;
}

CalibratedModel model_of_scara(std::uint64_t seed) {
  return model_of_wrist(measured_scara(true_scara(seed), 60, 20, seed));
}

std::string text_of(const ChangeReport& report) {
  std::string text = std::to_string(1e3 * report.error_m) + " mm -> " + std::to_string(1e3 * report.left_m) + " mm: ";
  for (const ChangeCause& cause : report.found)
    text += cause.effect.kind + " of joint " + std::to_string(cause.effect.joint + 1) + ": " +
            std::to_string(cause.size) + " " + cause.unit + "; ";
  return text;
}

TEST(ScaraChange, OfALinkIsNoMoveByMetres) {
  for (std::uint64_t seed = 1; seed <= 8; ++seed) {
    const CalibratedModel model = model_of_scara(seed);
    CorrectedRobot now = true_scara(seed);
    now.chain.joints[2].alpha_rad += radians(0.4);
    now.chain.joints[2].a_m += 1.5e-3;
    now.chain.joints[2].d_m += 8e-4;
    for (const std::uint64_t draw : {10, 20}) {
      const ChangeReport report = find_change(model, measured_scara(now, 14, 0, 1000 + draw + seed));
      EXPECT_EQ(report.verdict, ChangeVerdict::changed);
      EXPECT_TRUE(report.unnamed || report.more) << seed << ": " << text_of(report);
      EXPECT_LE(report.left_m, report.error_m) << seed << ": " << text_of(report);
      for (const ChangeCause& cause : report.found)
        EXPECT_LT(std::abs(cause.size), 0.02) << seed << ": " << text_of(report);
    }
  }
}

/// A target on the last axis, which a turn of that joint moves to first order only.
CorrectedRobot on_last_axis(CorrectedRobot robot, double off_axis_m) {
  robot.tools.at("").translation() = Eigen::Vector3d(off_axis_m, 0.0, 0.04);
  return robot;
}

TEST(ScaraChange, IsNamedByWhatTheRobotReallyDoesAndNotToFirstOrder) {
  for (std::uint64_t seed = 1; seed <= 6; ++seed) {
    const CorrectedRobot before = on_last_axis(true_scara(seed), 0.0);
    const CalibratedModel model = model_of_wrist(measured_scara(before, 60, 20, seed));
    CorrectedRobot tilted = before;
    tilted.chain.joints[3].alpha_rad += radians(1.2);
    const ChangeReport report = find_change(model, measured_scara(tilted, 14, 0, 1400 + seed));
    ASSERT_EQ(report.found.size(), 1U) << seed << ": " << text_of(report);
    EXPECT_EQ(declared_flag(report.found.front().effect.kind), &DeclaredModel::tool) << seed << ": " << text_of(report);
    EXPECT_FALSE(report.more || report.unnamed) << seed << ": " << text_of(report);
  }
}

TEST(ScaraChange, OfALinkIsNothingByWhichTheRobotErrsMore) {
  int unnamed = 0;
  for (std::uint64_t seed = 1; seed <= 6; ++seed) {
    for (const double off_axis_m : {0.0, 5e-4}) {
      const CorrectedRobot before = on_last_axis(true_scara(seed), off_axis_m);
      const CalibratedModel model = model_of_wrist(measured_scara(before, 60, 20, seed));
      for (const double a_m : {4.5e-4, 1.5e-3, 4.5e-3, 3e-2}) {
        CorrectedRobot bent = before;
        bent.chain.joints[1].a_m += a_m;
        const ChangeReport report = find_change(model, measured_scara(bent, 14, 0, 1500 + seed));
        EXPECT_EQ(report.verdict, ChangeVerdict::changed);
        if (!report.found.empty()) {
          EXPECT_LT(report.left_m, report.error_m) << seed << ": " << text_of(report);
        }
        for (const ChangeCause& cause : report.found)
          EXPECT_LT(std::abs(cause.size), 0.1) << seed << ": " << text_of(report);
        unnamed += report.unnamed ? 1 : 0;
      }
    }
  }
  EXPECT_GE(unnamed, 40) << "of 48";
}

TEST(ScaraChange, OfTheToolBesideABaseFoundAnewIsWhatThePosesTellOfIt) {
  for (std::uint64_t seed = 1; seed <= 6; ++seed) {
    CorrectedRobot now = true_scara(seed);
    now.sensor_from_base.translation() += Eigen::Vector3d(0.3, -0.2, 0.003);
    now.tools.at("").translation() += Eigen::Vector3d(4e-3, -2.3e-3, 1.5e-3);
    const ChangeReport report = find_change(model_of_scara(seed), measured_scara(now, 15, 0, 1600 + seed));
    EXPECT_TRUE(report.set_up_anew);
    ASSERT_EQ(report.found.size(), 1U) << seed << ": " << text_of(report);
    const ChangeCause& tool = report.found.front();
    ASSERT_EQ(declared_flag(tool.effect.kind), &DeclaredModel::tool) << seed << ": " << text_of(report);
    EXPECT_NEAR(std::hypot(tool.effect.values[0], tool.effect.values[1]), 4.6e-3, 2e-4) << seed;
    EXPECT_LT(std::abs(tool.effect.values[2]), 1e-3) << seed << ": along the axes the base makes up for it";
    EXPECT_GT(tool.standard_error, 1e-3) << seed;
  }
}

TEST(ScaraChange, OfAZeroOrTheToolIsNamedInFull) {
  for (std::uint64_t seed = 1; seed <= 4; ++seed) {
    const CalibratedModel model = model_of_scara(seed);
    CorrectedRobot turned = true_scara(seed);
    turned.chain.joints[1].theta_rad += radians(3.0);
    const ChangeReport zero = find_change(model, measured_scara(turned, 14, 0, 1100 + seed));
    ASSERT_EQ(zero.found.size(), 1U) << text_of(zero);
    EXPECT_EQ(declared_flag(zero.found.front().effect.kind), &DeclaredModel::joint_offset) << text_of(zero);
    EXPECT_EQ(zero.found.front().effect.joint, 1) << text_of(zero);
    EXPECT_NEAR(zero.found.front().size, radians(3.0), 4.0 * zero.found.front().standard_error);
    CorrectedRobot lowered = true_scara(seed);
    lowered.chain.joints[2].d_m += 1.5e-3;
    const ChangeReport lift = find_change(model, measured_scara(lowered, 14, 0, 1200 + seed));
    ASSERT_EQ(lift.found.size(), 1U) << text_of(lift);
    EXPECT_FALSE(lift.more || lift.unnamed) << text_of(lift);
    EXPECT_NEAR(lift.found.front().size, 1.5e-3, 3e-4) << text_of(lift);
    CorrectedRobot remounted = true_scara(seed);
    remounted.tools.at("").translation() += Eigen::Vector3d(0.2, -0.05, 0.08);
    const ChangeReport tool = find_change(model, measured_scara(remounted, 14, 0, 1300 + seed));
    ASSERT_FALSE(tool.found.empty());
    EXPECT_EQ(declared_flag(tool.found.front().effect.kind), &DeclaredModel::tool) << text_of(tool);
    EXPECT_FALSE(tool.more || tool.unnamed) << text_of(tool);
  }
}

}  // namespace
}  // namespace demecal
