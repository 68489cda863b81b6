// Gravity on the joints: by hand for a planar arm, and as the fall of potential energy for random arms.
#include "simulation/stance.hpp"

#include <gtest/gtest.h>

#include "kinematics/forward.hpp"
#include "planar_arm.hpp"
#include "random/random_stream.hpp"

namespace demecal {
namespace {

Eigen::Vector3d random_point(RandomStream& random) {
  return {random.real(-0.5, 0.5), random.real(-0.5, 0.5), random.real(-0.5, 0.5)};
}

Robot random_robot(Convention convention, RandomStream& random) {
  Robot robot;
  robot.chain.convention = convention;
  for (int i = 0; i < 6; ++i) {
    robot.chain.joints.push_back({.type = random.chance(0.3) ? JointType::prismatic : JointType::revolute,
                                  .theta_rad = random.real(-2, 2),
                                  .d_m = random.real(-0.5, 0.5),
                                  .a_m = random.real(-0.5, 0.5),
                                  .alpha_rad = random.real(-2, 2),
                                  .beta_rad = random.real(-0.2, 0.2)});
    robot.masses.push_back({random.real(0, 10), random_point(random)});
  }
  robot.chain.tool_m = random_point(random);
  robot.gravity_mps2 = 9.81 * random_point(random).normalized();
  return robot;
}

JointVector random_joints(int count, RandomStream& random) {
  JointVector q(count);
  for (double& value : q) value = random.real(-1.5, 1.5);
  return q;
}

/// Each link's frame is the flange of the arm cut off there.
Eigen::Isometry3d link_frame(const Chain& chain, const JointVector& q, int link) {
  Chain cut = chain;
  cut.joints.resize(static_cast<std::size_t>(link) + 1);
  return forward(cut, q.head(link + 1));
}

double potential_energy(const Robot& robot, const JointVector& q, double payload_kg) {
  double energy = -payload_kg * robot.gravity_mps2.dot(tool_position(robot.chain, q));
  for (int link = 0; link < robot.chain.size(); ++link) {
    const LinkMass& mass = robot.masses[static_cast<std::size_t>(link)];
    energy -= mass.mass_kg * robot.gravity_mps2.dot(link_frame(robot.chain, q, link) * mass.centre_m);
  }
  return energy;
}

TEST(Statics, TorqueOfAPlanarArmIsLeverTimesWeight) {
  const double q1 = 0.4, q2 = -0.9, payload_kg = 2.0;
  const std::vector<JointLoad> loads = gravity_loads(planar_arm(), joints({q1, q2}), payload_kg);
  const double reach = std::cos(q1 + q2);
  const double elbow = -kGravity * (kSecondMass * kSecondCentre + payload_kg * kSecondLink) * reach;
  const double shoulder = elbow - kGravity * (kSecondMass + payload_kg) * kFirstLink * std::cos(q1);
  EXPECT_NEAR(loads[1].effort, elbow, 1e-12);
  EXPECT_NEAR(loads[0].effort, shoulder, 1e-12);
}

TEST(Statics, EffortIsTheFallOfPotentialEnergy) {
  RandomStream random{501};
  for (int trial = 0; trial < 40; ++trial) {
    const Robot robot = random_robot(trial % 2 == 0 ? Convention::standard_dh : Convention::modified_dh, random);
    const JointVector q = random_joints(6, random);
    const std::vector<JointLoad> loads = gravity_loads(robot, q, 1.5);
    for (int joint = 0; joint < 6; ++joint) {
      constexpr double kStep = 1e-5;
      JointVector ahead = q, behind = q;
      ahead[joint] += kStep;
      behind[joint] -= kStep;
      const double fall = -(potential_energy(robot, ahead, 1.5) - potential_energy(robot, behind, 1.5)) / (2 * kStep);
      ASSERT_NEAR(loads[static_cast<std::size_t>(joint)].effort, fall, 1e-6) << "trial " << trial;
    }
  }
}

TEST(Statics, AJointWhoseAxisPointsDownFeelsNoTorque) {
  const std::vector<JointLoad> loads = gravity_loads(planar_arm(-Eigen::Vector3d::UnitZ()), joints({0.3, 0.7}), 5.0);
  EXPECT_NEAR(loads[0].effort, 0.0, 1e-12);
  EXPECT_NEAR(loads[1].effort, 0.0, 1e-12);
  EXPECT_GT(loads[0].moment_nm.norm(), 10.0);
}

TEST(Stance, WithoutTiltsEndsWhereForwardKinematicsDoes) {
  RandomStream random{502};
  for (int trial = 0; trial < 40; ++trial) {
    const Robot robot = random_robot(trial % 2 == 0 ? Convention::standard_dh : Convention::modified_dh, random);
    const JointVector q = random_joints(6, random);
    const Stance stance = stand(robot.chain, q);
    ASSERT_TRUE(stance.links.back().isApprox(forward(robot.chain, q), 1e-12));
    const Jacobian jacobian = joint_jacobian(robot.chain, q, robot.chain.tool_m);
    for (int joint = 0; joint < 6; ++joint) {
      const auto i = static_cast<std::size_t>(joint);
      const Eigen::Vector3d axis = stance.axes[i].linear().col(2);
      const bool revolute = is_revolute(robot.chain.joints[i]);
      const Eigen::Vector3d lever = tool_position(robot.chain, q) - stance.axes[i].translation();
      const Eigen::Vector3d moves = revolute ? axis.cross(lever) : axis;
      ASSERT_TRUE(jacobian.col(joint).head<3>().isApprox(moves, 1e-10)) << "trial " << trial;
    }
  }
}

}  // namespace
}  // namespace demecal
