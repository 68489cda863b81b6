// Guesses of the base: no orientation is far from all of them.
#include "fitting/base_search.hpp"

#include <gtest/gtest.h>

#include "fitting/known_arm.hpp"

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

TEST(NearestRotation, IsTheOneThatWasStretchedAndNeverAReflection) {
  RandomStream stream{53};
  for (int trial = 0; trial < 50; ++trial) {
    const Eigen::Matrix3d rotation = far_pose(stream).linear(), axes = far_pose(stream).linear();
    const Eigen::Vector3d stretch(stream.real(0.5, 2), stream.real(0.5, 2), stream.real(0.5, 2));
    const Eigen::Matrix3d stretched = rotation * axes * stretch.asDiagonal() * axes.transpose();
    EXPECT_LT((nearest_rotation(stretched) - rotation).norm(), 1e-10);
    EXPECT_NEAR(nearest_rotation(-stretched).determinant(), 1.0, 1e-12);
  }
}

}  // namespace
}  // namespace demecal
