// Guesses of the base: no orientation is far from all of them.
#include "fitting/base_search.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "decompositions/decompositions.hpp"
#include "effects/arm_state.hpp"
#include "fitting/known_arm.hpp"
#include "kinematics/forward.hpp"

namespace demecal {
namespace {

TEST(BaseCandidates, LeaveNoOrientationFarFromAll) {
  constexpr int kCount = 24;
  RandomStream stream{51};
  for (int trial = 0; trial < 500; ++trial) {
    const Eigen::Matrix3d any = far_pose(stream).linear();
    double nearest = 4.0;
    for (int i = 0; i < kCount; ++i) {
      const Eigen::Matrix3d rotation = spread_rotation(i, kCount);
      ASSERT_NEAR(rotation.determinant(), 1.0, 1e-12);
      nearest = std::min(nearest, rotation_between(rotation, any).norm());
    }
    EXPECT_LT(nearest, 1.4);  // rad; 80 degrees, well inside the basin of a registration
  }
}

TEST(BaseCandidates, BeginWithTheClosedFormWherePositionsWereMeasured) {
  RandomStream stream{52};
  KnownArm arm = perfect_arm(parallel_arm(), Frame::sensor);
  arm.truth.sensor_from_base = far_pose(stream);
  measure(arm, stream, {}, 10);
  const CorrectedRobot nominal = nominal_robot(arm.data);
  const auto bases = base_candidates(arm.data, observe(arm.data, all_poses(arm.data), nominal), nominal, 5);
  ASSERT_EQ(bases.size(), 6u);
  EXPECT_TRUE(bases[0].isApprox(arm.truth.sensor_from_base, 1e-9));
}

TEST(BaseSearch, FindsAnUnknownToolAlongASmoothPath) {
  RandomStream stream{54};
  for (int trial = 0; trial < 60; ++trial) {
    KnownArm arm = perfect_arm(parallel_arm(), Frame::sensor);
    arm.truth.sensor_from_base = far_pose(stream);
    measure(arm, stream, {}, 60);
    Eigen::VectorXd phases(6);
    for (double& phase : phases) phase = stream.real(0.0, 6.0);
    const Eigen::Vector3d tool_m(0.08, 0.03, 0.12);
    for (std::size_t i = 0; i < arm.data.poses.size(); ++i) {
      MeasuredPose& pose = arm.data.poses[i];
      for (int joint = 0; joint < 6; ++joint)
        pose.joints[joint] =
            (1.0 + 0.3 * joint) * std::sin(0.006 * static_cast<double>(i) * (0.9 + 0.4 * joint) + phases[joint]);
      pose.position_m = arm.truth.sensor_from_base * (forward(arm.data.robot.chain, pose.joints) * tool_m);
    }
    arm.data.robot.chain.tool_m.setZero();
    const CorrectedRobot found =
        locate_base_and_tools(arm.data, all_poses(arm.data), kPlaced, nominal_robot(arm.data), {});
    double largest_m = 0.0;
    for (const MeasuredPose& pose : arm.data.poses)
      largest_m = std::max(largest_m, (found.predict(Stop(pose), pose.target).translation() - *pose.position_m).norm());
    EXPECT_LT(largest_m, 1e-3) << trial;
  }
}

}  // namespace
}  // namespace demecal
