// Forward kinematics against closed forms and against formulations that share no code with it.
#include "kinematics/forward.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "random_arm.hpp"

namespace demecal {
namespace {

/// The matrix of thesis A.2, element by element.
Eigen::Matrix4d thesis_matrix(double theta, double d, double a, double alpha) {
  const double ct = std::cos(theta), st = std::sin(theta), ca = std::cos(alpha), sa = std::sin(alpha);
  Eigen::Matrix4d matrix;
  matrix << ct, -st * ca, st * sa, a * ct,  //
      st, ct * ca, -ct * sa, a * st,        //
      0, sa, ca, d,                         //
      0, 0, 0, 1;
  return matrix;
}

Eigen::Affine3d rotation(double angle, const Eigen::Vector3d& axis) {
  return Eigen::Affine3d(Eigen::AngleAxisd(angle, axis));
}

Eigen::Affine3d translation(double length, const Eigen::Vector3d& axis) {
  return Eigen::Affine3d(Eigen::Translation3d(length * axis));
}

/// What stands before a joint's axis in its link, and what follows it.
struct Sides {
  Eigen::Affine3d before, after;
};
Sides sides(const Joint& joint, Convention convention) {
  const Eigen::Vector3d x = Eigen::Vector3d::UnitX(), y = Eigen::Vector3d::UnitY(), z = Eigen::Vector3d::UnitZ();
  const Eigen::Affine3d axis = rotation(joint.theta_rad, z) * translation(joint.d_m, z);
  if (convention == Convention::standard_dh) {
    return {Eigen::Affine3d::Identity(),
            axis * translation(joint.a_m, x) * rotation(joint.alpha_rad, x) * rotation(joint.beta_rad, y)};
  }
  return {rotation(joint.alpha_rad, x) * translation(joint.a_m, x) * rotation(joint.beta_rad, y), axis};
}

/// Product of exponentials: screws along the joint axes as they lie in the zero pose, then the zero pose.
Eigen::Affine3d product_of_exponentials(const Chain& chain, const JointVector& q) {
  Eigen::Affine3d motion = Eigen::Affine3d::Identity(), zero_pose = Eigen::Affine3d::Identity();
  for (int i = 0; i < chain.size(); ++i) {
    const Joint& joint = chain.joints[static_cast<std::size_t>(i)];
    const Sides link = sides(joint, chain.convention);
    zero_pose = zero_pose * link.before;
    const Eigen::Vector3d axis = zero_pose.linear().col(2), point = zero_pose.translation();
    motion = motion * (!is_revolute(joint) ? translation(q[i], axis)
                                           : Eigen::Affine3d(Eigen::Translation3d(point)) * rotation(q[i], axis) *
                                                 Eigen::Translation3d(-point));
    zero_pose = zero_pose * link.after;
  }
  return motion * zero_pose;
}

TEST(Forward, FollowsTheClosedFormOfThePlanarArm) {
  RandomStream stream{101};
  for (int trial = 0; trial < 50; ++trial) {
    const double l1 = stream.real(0.1, 1.0), l2 = stream.real(0.1, 1.0);
    Chain chain;
    chain.joints.resize(2);
    chain.joints[0].a_m = l1;
    chain.joints[1].a_m = l2;
    const JointVector q = random_change(stream, 2, 3.0);
    const Eigen::Isometry3d flange = forward(chain, q);
    EXPECT_NEAR(flange.translation().x(), l1 * std::cos(q[0]) + l2 * std::cos(q[0] + q[1]), 1e-14);
    EXPECT_NEAR(flange.translation().y(), l1 * std::sin(q[0]) + l2 * std::sin(q[0] + q[1]), 1e-14);
    EXPECT_NEAR(flange.translation().z(), 0.0, 1e-14);
    EXPECT_NEAR(flange.linear()(1, 0), std::sin(q[0] + q[1]), 1e-14);
  }
}

TEST(Forward, PutsThePumaAtZeroWhereItsLinksAddUp) {
  const Chain puma = wrist_arm();
  const Eigen::Isometry3d flange = forward(puma, JointVector::Zero(6));
  EXPECT_TRUE(flange.translation().isApprox(Eigen::Vector3d(0.650, 0.191, 0.600 + 0.125), 1e-15));
  EXPECT_TRUE(flange.linear().isIdentity(1e-15));
  EXPECT_TRUE(
      tool_position(puma, JointVector::Zero(6)).isApprox(Eigen::Vector3d(0.650, 0.191, 0.600 + 0.125 + 0.1), 1e-15));
}

TEST(Forward, IsTheProductOfTheThesisMatrices) {
  RandomStream stream{102};
  for (int joints = 1; joints <= kMaxJoints; ++joints) {
    Chain chain = random_arm(stream, joints, Convention::standard_dh, 0.3);
    for (Joint& joint : chain.joints) joint.beta_rad = 0.0;
    const JointVector q = random_joints(stream, chain);
    Eigen::Matrix4d product = Eigen::Matrix4d::Identity();
    for (int i = 0; i < joints; ++i) {
      const Joint& joint = chain.joints[static_cast<std::size_t>(i)];
      const bool revolute = is_revolute(joint);
      product = product * thesis_matrix(joint.theta_rad + (revolute ? q[i] : 0), joint.d_m + (revolute ? 0 : q[i]),
                                        joint.a_m, joint.alpha_rad);
    }
    EXPECT_LT((forward(chain, q).matrix() - product).norm(), 1e-13) << joints;
  }
}

TEST(Forward, IsTheProductOfExponentialsInBothConventions) {
  RandomStream stream{103};
  for (const Convention convention : kConventions) {
    for (int joints = 1; joints <= kMaxJoints; ++joints) {
      const Chain chain = random_arm(stream, joints, convention, 0.3);
      const JointVector q = random_joints(stream, chain);
      const Eigen::Affine3d expected = product_of_exponentials(chain, q);
      EXPECT_LT((forward(chain, q).matrix() - expected.matrix()).norm(), 1e-13) << joints;
    }
  }
}

TEST(Forward, OfModifiedLinksShiftedByOneEqualsStandardLinks) {
  RandomStream stream{104};
  for (int joints = 1; joints <= kMaxJoints; ++joints) {
    Chain standard = random_arm(stream, joints, Convention::standard_dh, 0.3);
    for (Joint& joint : standard.joints) joint.beta_rad = 0.0;
    Chain modified = standard;
    modified.convention = Convention::modified_dh;
    Joint before;  // the base: no twist, no length
    for (std::size_t i = 0; i < modified.joints.size(); ++i) {
      modified.joints[i].alpha_rad = before.alpha_rad;
      modified.joints[i].a_m = before.a_m;
      before = standard.joints[i];
    }
    const Eigen::Affine3d last =
        translation(before.a_m, Eigen::Vector3d::UnitX()) * rotation(before.alpha_rad, Eigen::Vector3d::UnitX());
    const JointVector q = random_joints(stream, standard);
    const Eigen::Matrix4d shifted = forward(modified, q).matrix() * last.matrix();
    EXPECT_LT((forward(standard, q).matrix() - shifted).norm(), 1e-13) << joints;
  }
}

TEST(Forward, StaysRigidOnLongChains) {
  RandomStream stream{105};
  for (int trial = 0; trial < 50; ++trial) {
    const Chain chain = random_arm(stream, kMaxJoints, Convention::standard_dh);
    const Eigen::Matrix3d rotation_part = forward(chain, random_joints(stream, chain)).linear();
    EXPECT_LT((rotation_part * rotation_part.transpose() - Eigen::Matrix3d::Identity()).norm(), 1e-14);
    EXPECT_GT(rotation_part.determinant(), 0.0);
  }
}

TEST(ForwardDeathTest, RefusesJointsOfAnotherArm) {
  GTEST_FLAG_SET(death_test_style, "threadsafe");
  EXPECT_DEATH(forward(wrist_arm(), JointVector::Zero(5)), "5 joint values for 6 joints");
}

}  // namespace
}  // namespace demecal
