// Arms whose places have moved: against products of matrices, and every unit's twist against differences.
#include "kinematics/forward.hpp"

#include <gtest/gtest.h>

#include "kinematics/angles.hpp"
#include "kinematics/inverse.hpp"
#include "kinematics/random_arm.hpp"

namespace demecal {
namespace {

PlaceMotions random_motions(RandomStream& stream, const Chain& chain, double largest) {
  PlaceMotions motions(6, chain.size() + 1);
  for (double& value : motions.reshaped()) value = stream.real(-largest, largest);
  return motions;
}

Eigen::Matrix4d matrix_of(const SmallMotion& motion) {
  Eigen::Matrix4d matrix = Eigen::Matrix4d::Identity();
  matrix.topLeftCorner<3, 3>() = rotation_of(motion.tail<3>());
  matrix.topRightCorner<3, 1>() = motion.head<3>();
  return matrix;
}

/// The link's transforms before the joint's axis, and from there on.
std::pair<Eigen::Matrix4d, Eigen::Matrix4d> halves(const Chain& chain, int joint, double q) {
  Joint link = chain.joints[static_cast<std::size_t>(joint)];
  const Chain whole{chain.convention, {link}, Eigen::Vector3d::Zero()};
  if (chain.convention == Convention::modified_dh) link.theta_rad = link.d_m = 0.0;
  Chain first{chain.convention, {link}, Eigen::Vector3d::Zero()};
  const Eigen::Matrix4d before = chain.convention == Convention::standard_dh
                                     ? Eigen::Matrix4d(Eigen::Matrix4d::Identity())
                                     : forward(first, JointVector::Zero(1)).matrix();
  return {before, before.inverse() * forward(whole, JointVector::Constant(1, q)).matrix()};
}

TEST(Displaced, ArmsAreTheProductOfLinksAndMotions) {
  RandomStream stream{141};
  for (const Convention convention : {Convention::standard_dh, Convention::modified_dh}) {
    for (int joints = 3; joints <= kMaxJoints; ++joints) {
      const Chain chain = random_arm(stream, joints, convention, 0.3);
      const JointVector q = random_joints(stream, chain);
      const PlaceMotions motions = random_motions(stream, chain, 0.5);
      Eigen::Matrix4d expected = Eigen::Matrix4d::Identity();
      for (int i = 0; i < joints; ++i) {
        const auto [before, after] = halves(chain, i, q[i]);
        expected = expected * before * matrix_of(motions.col(i)) * after;
      }
      expected = expected * matrix_of(motions.col(joints));
      EXPECT_LT((forward(chain, q, motions).matrix() - expected).norm(), 1e-12);
    }
  }
}

TEST(Displaced, ArmsThatDoNotMoveStandAsEverToTheBit) {
  RandomStream stream{142};
  const Chain chain = mounted_arm(stream, 7, Convention::standard_dh, 0.3);
  const JointVector q = random_joints(stream, chain);
  const PlaceMotions none = PlaceMotions::Zero(6, 8);
  EXPECT_EQ(forward(chain, q, none).matrix(), forward(chain, q).matrix());
  const Eigen::Vector3d point_m{0.1, 0.2, 0.3};
  EXPECT_EQ(differential_kinematics(chain, q, point_m, none).kinematics.links,
            differential_kinematics(chain, q, point_m).links);
}

TEST(Displaced, ArmsHaveTheJacobiansThatDifferencesShow) {
  RandomStream stream{143};
  constexpr double kStep = 1e-6;
  const Eigen::Vector3d point_m{0.1, 0.2, -0.1};
  for (const Convention convention : {Convention::standard_dh, Convention::modified_dh}) {
    const Chain chain = mounted_arm(stream, 6, convention, 0.3);
    const JointVector q = random_joints(stream, chain);
    const PlaceMotions motions = random_motions(stream, chain, 0.3);
    const auto pose = [&](const JointVector& joints, const PlaceMotions& places) {
      return Eigen::Isometry3d(forward(chain, joints, places) * Eigen::Translation3d(point_m));
    };
    const DisplacedKinematics arm = differential_kinematics(chain, q, point_m, motions);
    const Eigen::Vector3d point = pose(q, motions).translation();
    for (int joint = 0; joint < 6; ++joint) {
      const JointVector step = kStep * JointVector::Unit(6, joint);
      const PoseError slope = pose_error(pose(q - step, motions), pose(q + step, motions)) / (2 * kStep);
      EXPECT_LT((arm.kinematics.joints.col(joint) - slope).norm(), 1e-8);
    }
    for (int place = 0; place <= 6; ++place) {
      for (int axis = 0; axis < 6; ++axis) {
        PlaceMotions ahead = motions, behind = motions;
        ahead(axis, place) += kStep;
        behind(axis, place) -= kStep;
        const PoseError slope = pose_error(pose(q, behind), pose(q, ahead)) / (2 * kStep);
        const SmallMotion twist =
            unit_twist(arm.places[static_cast<std::size_t>(place)], motions.col(place), axis, point);
        EXPECT_LT((twist - slope).norm(), 1e-8) << place << ' ' << axis;
      }
    }
  }
}

TEST(Displaced, FramesAreShiftedAndThenTurnedAboutTheirNewOrigin) {
  const Eigen::Isometry3d frame(Eigen::Translation3d(1, 2, 3));
  const Eigen::Isometry3d after = moved(frame, (SmallMotion() << 0.1, 0, 0, 0, 0, 0.5).finished());
  EXPECT_TRUE(after.translation().isApprox(Eigen::Vector3d(1.1, 2, 3)));
  EXPECT_TRUE(after.linear().isApprox(rotation_of({0, 0, 0.5})));
}

}  // namespace
}  // namespace demecal
