// What effects do to the corrected robot's predictions, joints and commands.
#include <gtest/gtest.h>

#include "prediction/corrected_robot.hpp"
#include "prediction/measurement.hpp"
#include "prediction/random_effects.hpp"

namespace demecal {
namespace {

/// A robot with errors of all sorts, whose maker describes another.
CorrectedRobot erring_robot(RandomStream& stream, const Chain& nominal, double size, int of_each) {
  CorrectedRobot robot = random_robot(stream, nominal, 2e-3, 0.01);
  robot.described = heavy(stream, nominal);
  robot.effects = random_effects(robot.described, stream, size, of_each);
  return robot;
}

CorrectedRobot without_effects(CorrectedRobot robot) {
  robot.effects.clear();
  return robot;
}

/// The sum of what every unit motion alone does to the tool at first order, from the places of the identified chain.
PoseError first_order(const CorrectedRobot& robot, const Stop& stop, const std::string& target) {
  const CorrectedRobot bare = without_effects(robot);
  Robot identified;
  identified.chain = robot.chain;
  const ArmState at = arm_state(identified, Stop(robot.corrected_joints(stop.joints)));
  const Eigen::Isometry3d tool = bare.predict(stop, target);
  ArmState nominal = arm_state(robot.described, stop);
  nominal.tool_in_sensor_m = tool.translation();
  PoseError sum = PoseError::Zero();
  for (const Effect& effect : robot.effects) {
    std::vector<UnitMotion> motions;
    append_unit_motions(effect, robot.described, nominal, motions);
    for (const UnitMotion& motion : motions) {
      Eigen::Isometry3d place = Eigen::Isometry3d::Identity();
      if (motion.place != kSensorPlace) {
        place = robot.sensor_from_base * at.places[static_cast<std::size_t>(motion.place)];
      }
      const Eigen::Vector3d axis = place.linear().col(motion.axis % 3);
      const double size = motion.size * effect.value(static_cast<std::size_t>(motion.coefficient));
      if (motion.axis < 3) {
        sum.head<3>() += size * axis;
      } else {
        sum.head<3>() += size * axis.cross(tool.translation() - place.translation());
        sum.tail<3>() += size * axis;
      }
    }
  }
  return sum;
}

TEST(EffectsOfARobot, MoveTheToolAsTheSumOfTheirMotionsAtFirstOrder) {
  RandomStream stream{661};
  for (const Convention convention : {Convention::standard_dh, Convention::modified_dh}) {
    for (int trial = 0; trial < 10; ++trial) {
      const CorrectedRobot robot = erring_robot(stream, mounted_arm(stream, 6, convention, 0.2), 1e-6, 3);
      const Stop stop = random_stop(stream, robot.chain);
      const PoseError moved = pose_error(without_effects(robot).predict(stop, "B"), robot.predict(stop, "B"));
      const PoseError expected = first_order(robot, stop, "B");
      EXPECT_GT(expected.norm(), 1e-6);
      EXPECT_LT((moved - expected).norm(), 1e-8);
    }
  }
}

TEST(EffectsOfARobot, AboutAJointsAxisAddToItsValue) {
  RandomStream stream{662};
  for (int trial = 0; trial < 10; ++trial) {
    CorrectedRobot robot = random_robot(stream, random_arm(stream, 6, Convention::standard_dh, 0.3), 0.01, 0.0);
    robot.described = heavy(stream, robot.chain);
    const JointVector q = random_joints(stream, robot.chain);
    JointVector shifted = q;
    for (int joint = 0; joint < 6; ++joint) {
      const double offset = stream.real(-0.1, 0.1);
      robot.effects.push_back({.kind = "joint_offset", .joint = joint, .values = {offset}});
      shifted[joint] += offset;
    }
    EXPECT_EQ(robot.actual_joints(q), shifted);
    EXPECT_LT((robot.predict(q, "").matrix() - without_effects(robot).predict(shifted, "").matrix()).norm(), 1e-14);
  }
}

TEST(EffectsOfARobot, AboutAJointsAxisDoNotPassOnToJointsThatItsCommandTurns) {
  RandomStream stream{668};
  for (int trial = 0; trial < 10; ++trial) {
    CorrectedRobot robot = random_robot(stream, mounted_arm(stream, 6, Convention::standard_dh), 0.01, 0.01);
    robot.described = heavy(stream, robot.chain);
    Chain uncoupled = robot.chain;  // commanded by what its drives turn
    uncoupled.couplings.clear();
    const JointVector q = random_joints(stream, robot.chain);
    JointVector turned = driven_joints(robot.chain, q);
    for (int joint = 0; joint < 6; ++joint) {
      const double offset = stream.real(-0.1, 0.1);
      robot.effects.push_back({.kind = "joint_offset", .joint = joint, .values = {offset}});
      turned[joint] += offset + robot.corrections[static_cast<std::size_t>(joint)](q[joint]);
    }
    const Eigen::Matrix4d expected = (robot.sensor_from_base * forward(uncoupled, turned) * robot.tool("")).matrix();
    EXPECT_LT((robot.predict(q, "").matrix() - expected).norm(), 1e-13);
  }
}

TEST(EffectsOfARobot, WithoutCoefficientsDoNothing) {
  RandomStream stream{663};
  CorrectedRobot robot = erring_robot(stream, wrist_arm(), 1e-3, 2);
  const Stop stop = random_stop(stream, robot.chain);
  for (Effect& effect : robot.effects) effect.values.clear();
  EXPECT_EQ(robot.predict(stop, "B").matrix(), without_effects(robot).predict(stop, "B").matrix());
}

TEST(EffectsOfARobot, FollowTheSideAJointCameFrom) {
  RandomStream stream{664};
  CorrectedRobot robot = random_robot(stream, wrist_arm(), 0.0, 0.0);
  robot.described = heavy(stream, robot.chain);
  robot.effects = {{.kind = "backlash", .joint = 1, .values = {1e-3}}};
  Stop stop(random_joints(stream, robot.chain));
  EXPECT_EQ(robot.actual_joints(stop), stop.joints) << "the side is not known";
  stop.approach = JointVector::Zero(6);
  stop.approach[1] = 1.0;
  EXPECT_NEAR(robot.actual_joints(stop)[1] - stop.joints[1], -0.5e-3, 1e-15);
  stop.approach[1] = -1.0;
  EXPECT_NEAR(robot.actual_joints(stop)[1] - stop.joints[1], 0.5e-3, 1e-15);
}

TEST(EffectsOfARobot, CountInResidualsAndToolErrorsAtThePosesOwnCircumstances) {
  RandomStream stream{665};
  const CorrectedRobot robot = erring_robot(stream, wrist_arm(), 1e-3, 2);
  const Stop stop = random_stop(stream, robot.chain);
  DataSet data;
  data.robot = robot.described;
  MeasuredPose pose;
  pose.joints = stop.joints;
  pose.approach = stop.approach;
  pose.payload_kg = stop.payload_kg;
  pose.temperature_celsius = stop.temperature_celsius;
  pose.time_s = stop.time_s;
  pose.position_m = robot.predict(stop, "").translation();
  EXPECT_EQ(tool_error_m(robot, data, pose), 0.0);
  EXPECT_EQ(residual(robot, data, pose).norm(), 0.0);
  EXPECT_GT(tool_error_m(without_effects(robot), data, pose), 1e-4);
  pose.payload_kg.reset();
  EXPECT_GT(tool_error_m(robot, data, pose), 1e-6);
}

TEST(EffectsOfARobot, LeaveTheJacobianOfTheArmAsTheyMoveIt) {
  RandomStream stream{666};
  constexpr double kStep = 1e-6;
  CorrectedRobot robot = random_robot(stream, mounted_arm(stream, 6, Convention::modified_dh, 0.2), 0.01, 0.1);
  robot.described = heavy(stream, robot.chain);
  for (const char* kind : {"backlash", "joint_offset", "registration", "drift", "geometry"}) {
    for (const EffectLaw* law : {find_law(kind)}) {
      // These do not depend on the joints: their part of the Jacobian is exact.
      for (const Effect& effect : law->proposals(robot.described, all_evidence(robot.chain, true))) {
        if (effect.form != "seated") robot.effects.push_back(of_size(effect, robot.described, stream, 0.02));
      }
    }
  }
  const Stop stop = random_stop(stream, robot.chain);
  const PoseAndJacobian at = robot.predict_with_jacobian(stop, "B");
  EXPECT_LT((at.pose.matrix() - robot.predict(stop, "B").matrix()).norm(), 1e-13);
  for (int i = 0; i < 6; ++i) {
    JointVector step = kStep * JointVector::Unit(6, i);
    const Eigen::Isometry3d ahead = robot.predict(stop.with_joints(stop.joints + step), "B");
    const Eigen::Isometry3d behind = robot.predict(stop.with_joints(stop.joints - step), "B");
    EXPECT_LT((at.jacobian.col(i) - pose_error(behind, ahead) / (2 * kStep)).norm(), 1e-8) << i;
  }
}

TEST(EffectsOfARobot, AreUndoneByTheCorrectedCommand) {
  RandomStream stream{667};
  int regular = 0;
  for (int trial = 0; trial < 50; ++trial) {
    const CorrectedRobot robot = erring_robot(stream, wrist_arm(), 3e-4, 1);
    Stop desired = random_stop(stream, robot.chain);
    const Eigen::Isometry3d goal =
        robot.sensor_from_base * forward(robot.described.chain, desired.joints) * robot.tool("");
    const InverseSolution command = corrected_command(robot, robot.described.chain, desired);
    if (command.smallest_singular < 0.15) continue;
    ++regular;
    EXPECT_EQ(command.status, InverseStatus::converged);
    EXPECT_LT(pose_error(robot.predict(desired.with_joints(command.q), ""), goal).norm(), 1e-8);
  }
  EXPECT_GT(regular, 10);
}

}  // namespace
}  // namespace demecal
