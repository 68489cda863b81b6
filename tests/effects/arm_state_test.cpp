// The nominal arm's places, links and loads against forward kinematics and the work of gravity.
#include "effects/arm_state.hpp"

#include <gtest/gtest.h>

#include "laden_arm.hpp"

namespace demecal {
namespace {

/// The work gravity does from the base's origin to where the arm stands, Nm.
double work_of_gravity(const Robot& robot, const Stop& stop) {
  double work = 0.0;
  Chain inner = robot.chain;
  inner.joints.clear();
  for (std::size_t i = 0; i < robot.chain.joints.size(); ++i) {
    inner.joints.push_back(robot.chain.joints[i]);
    const Eigen::Isometry3d link = forward(inner, stop.joints.head(inner.size()));
    if (!robot.masses.empty())
      work += robot.masses[i].mass_kg * robot.gravity_mps2.dot(link * robot.masses[i].centre_m);
  }
  return work + stop.payload_kg * robot.gravity_mps2.dot(tool_position(robot.chain, stop.joints));
}

TEST(ArmState, EndsAtTheFlangeAndTheToolPoint) {
  RandomStream stream{31, 1};
  for (const Arm arm : kArms) {
    const Robot robot = laden_arm(stream, arm);
    const Stop stop = random_stop(stream, robot);
    const ArmState state = arm_state(robot, stop);
    ASSERT_EQ(state.places.size(), 7u);
    ASSERT_EQ(state.links.size(), 6u);
    const Eigen::Isometry3d flange = forward(robot.chain, stop.joints);
    EXPECT_TRUE(state.places.back().isApprox(flange, 1e-13));
    EXPECT_TRUE(state.links.back().isApprox(flange, 1e-13));
    EXPECT_TRUE(state.payload_point_m.isApprox(tool_position(robot.chain, stop.joints), 1e-13));
  }
}

TEST(ArmState, HasEachJointsAxisAlongZOfItsPlace) {
  RandomStream stream{31, 2};
  for (const Arm arm : kArms) {
    const Robot robot = laden_arm(stream, arm);
    const Stop stop = random_stop(stream, robot);
    const ArmState state = arm_state(robot, stop);
    const Jacobian jacobian = joint_jacobian(robot.chain, stop.joints, robot.chain.tool_m);
    for (int joint = 0; joint < 6; ++joint) {
      const bool revolute = is_revolute(robot.chain, joint);
      const PoseError twist =
          twist_of({0, joint, revolute ? 5 : 2, 1.0}, state, Eigen::Isometry3d::Identity(), state.payload_point_m);
      EXPECT_LT((twist - jacobian.col(joint)).norm(), 1e-12) << "joint " << joint + 1;
    }
  }
}

TEST(ArmState, KnowsPlacesThatItsOwnJointDoesNotMove) {
  RandomStream stream{31, 3};
  for (const Arm arm : kArms) {
    const Robot robot = laden_arm(stream, arm);
    Stop stop = random_stop(stream, robot);
    const ArmState before = arm_state(robot, stop);
    stop.joints[3] += 0.4;
    const ArmState after = arm_state(robot, stop);
    for (std::size_t place = 0; place <= 3; ++place) {
      EXPECT_TRUE(after.places[place].isApprox(before.places[place], 1e-14)) << place;
    }
    EXPECT_FALSE(after.places[4].isApprox(before.places[4], 1e-3));
  }
}

TEST(ArmState, TorqueIsTheWorkOfGravityPerMotionOfTheJoint) {
  RandomStream stream{31, 4};
  constexpr double kStep = 1e-5;
  for (const Arm arm : kArms) {
    const Robot robot = laden_arm(stream, arm);
    const Stop stop = random_stop(stream, robot);
    const ArmState state = arm_state(robot, stop);
    for (int joint = 0; joint < 6; ++joint) {
      Stop ahead = stop, behind = stop;
      ahead.joints[joint] += kStep;
      behind.joints[joint] -= kStep;
      const double torque = (work_of_gravity(robot, ahead) - work_of_gravity(robot, behind)) / (2 * kStep);
      EXPECT_NEAR(state.torque(robot.chain, joint), torque, 1e-5) << "joint " << joint + 1;
    }
  }
}

TEST(ArmState, BearsThePayloadAloneWhereMassesAreUnknown) {
  RandomStream stream{31, 5};
  Robot robot = laden_arm(stream, Arm::standard);
  robot.masses.clear();
  Stop stop = random_stop(stream, robot);
  const ArmState laden = arm_state(robot, stop);
  EXPECT_NEAR(laden.loads[0].force_n.norm(), 9.81 * stop.payload_kg, 1e-12);
  stop.payload_kg = 0.0;
  const ArmState empty = arm_state(robot, stop);
  for (const PlaceLoad& load : empty.loads) EXPECT_EQ(load.force_n.norm() + load.moment_nm.norm(), 0.0);
}

TEST(ArmState, ApproachIsZeroWhereItIsUnknown) {
  RandomStream stream{31, 6};
  const Robot robot = laden_arm(stream, Arm::standard);
  Stop stop = random_stop(stream, robot);
  EXPECT_EQ(arm_state(robot, stop).approach(2), stop.approach[2]);
  stop.approach = ApproachSigns();
  EXPECT_EQ(arm_state(robot, stop).approach(2), 0.0);
}

}  // namespace
}  // namespace demecal
