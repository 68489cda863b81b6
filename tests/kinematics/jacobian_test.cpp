// The analytic Jacobians by joints and by link parameters against central differences.
#include <gtest/gtest.h>

#include "kinematics/forward.hpp"
#include "kinematics/joint_kinematics.hpp"
#include "random_arm.hpp"

namespace demecal {
namespace {

/// Central differences of smooth functions of order one err by h^2 and by epsilon / h.
constexpr double kStep = 1e-5;
constexpr double kTolerance = 1e-9;

using Twist = Eigen::Matrix<double, 6, 1>;

/// The motion between two poses a step apart: linear of `point`, then angular from the change of the rotation matrix.
Twist difference(const Eigen::Isometry3d& behind, const Eigen::Isometry3d& ahead, const Eigen::Vector3d& point) {
  const Eigen::Matrix3d middle = (ahead.linear() + behind.linear()) / 2;
  const Eigen::Matrix3d spin = (ahead.linear() - behind.linear()) * middle.transpose() / (2 * kStep);
  Twist twist;
  twist << (ahead * point - behind * point) / (2 * kStep), 0.5 * (spin(2, 1) - spin(1, 2)),
      0.5 * (spin(0, 2) - spin(2, 0)), 0.5 * (spin(1, 0) - spin(0, 1));
  return twist;
}

Twist by_joint(const Chain& chain, JointVector q, int joint, const Eigen::Vector3d& point) {
  q[joint] += kStep;
  const Eigen::Isometry3d ahead = forward(chain, q);
  q[joint] -= 2 * kStep;
  return difference(forward(chain, q), ahead, point);
}

Twist by_link(Chain chain, const JointVector& q, int column, const Eigen::Vector3d& point) {
  const auto which = static_cast<LinkParameter>(column % kLinkParameters);
  double& parameter = chain.joints[static_cast<std::size_t>(column / kLinkParameters)].parameter(which);
  parameter += kStep;
  const Eigen::Isometry3d ahead = forward(chain, q);
  parameter -= 2 * kStep;
  return difference(forward(chain, q), ahead, point);
}

/// Calls `check(chain, q, point)` for random arms of 3 to 9 joints of both conventions and kinds.
template <typename Check>
void on_random_arms(std::uint64_t seed, Check check) {
  RandomStream stream{seed};
  for (const Convention convention : kConventions) {
    for (int joints = 3; joints <= kMaxJoints; ++joints) {
      for (int trial = 0; trial < 5; ++trial) {
        const Chain chain = mounted_arm(stream, joints, convention, 0.3);
        check(chain, random_joints(stream, chain), chain.tool_m);
      }
    }
  }
}

TEST(JointJacobian, IsTheDerivativeOfThePose) {
  on_random_arms(201, [](const Chain& chain, const JointVector& q, const Eigen::Vector3d& point) {
    const Jacobian jacobian = joint_jacobian(chain, q, point);
    ASSERT_EQ(jacobian.cols(), chain.size());
    for (int joint = 0; joint < chain.size(); ++joint) {
      EXPECT_LT((jacobian.col(joint) - by_joint(chain, q, joint, point)).norm(), kTolerance) << joint;
    }
  });
}

TEST(LinkJacobian, IsTheDerivativeOfThePoseByEveryParameterBetaIncluded) {
  on_random_arms(202, [](const Chain& chain, const JointVector& q, const Eigen::Vector3d& point) {
    const LinkJacobian jacobian = link_jacobian(chain, q, point);
    ASSERT_EQ(jacobian.cols(), chain.size() * kLinkParameters);
    for (int column = 0; column < jacobian.cols(); ++column) {
      EXPECT_LT((jacobian.col(column) - by_link(chain, q, column, point)).norm(), kTolerance) << column;
    }
  });
}

TEST(DifferentialKinematics, AgreesWithItsPartsToTheBit) {
  on_random_arms(203, [](const Chain& chain, const JointVector& q, const Eigen::Vector3d& point) {
    const Kinematics all = differential_kinematics(chain, q, point);
    EXPECT_EQ(all.flange.matrix(), forward(chain, q).matrix());
    EXPECT_EQ(all.joints, joint_jacobian(chain, q, point));
    EXPECT_EQ(all.links, link_jacobian(chain, q, point));
    const JointKinematics few = joint_kinematics(FixedTurns(chain), q, point);
    EXPECT_EQ(few.flange.matrix(), all.flange.matrix());
    EXPECT_EQ(few.joints, all.joints);
  });
}

}  // namespace
}  // namespace demecal
