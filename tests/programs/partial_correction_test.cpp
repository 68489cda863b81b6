// A correction is made as far as it is surely known.
#include <gtest/gtest.h>

#include <cmath>

#include "programs/target_correction.hpp"
#include "random/random_stream.hpp"

namespace demecal {
namespace {

TEST(DeterminedPart, IsAllOfASureCorrectionAndNoneOfAnUnsureOne) {
  const Eigen::Vector3d correction(1e-3, -2e-3, 5e-4);
  const DeterminedPart sure = determined_part(correction, 1e-12 * Eigen::Matrix3d::Identity(), 5e-5);
  EXPECT_EQ(sure.applied, correction);
  EXPECT_EQ(sure.deviation, 0.0);
  const DeterminedPart unsure = determined_part(correction, Eigen::Matrix3d::Identity(), 5e-5);
  EXPECT_TRUE(unsure.applied.isZero(0.0));
  EXPECT_DOUBLE_EQ(unsure.deviation, 1.0);
}

TEST(DeterminedPart, LeavesTheOneDirectionThatIsNotKnown) {
  const Eigen::Vector3d direction = Eigen::Vector3d(1, 2, -2).normalized();
  const Eigen::Matrix3d covariance = 1e-12 * Eigen::Matrix3d::Identity() + 1e-4 * direction * direction.transpose();
  const Eigen::Vector3d correction(1e-3, -2e-3, 5e-4);
  const DeterminedPart part = determined_part(correction, covariance, 5e-5);
  EXPECT_NEAR(std::abs(part.omitted.dot(direction)), 1.0, 1e-9);
  EXPECT_NEAR(part.applied.dot(direction), 0.0, 1e-9);
  EXPECT_LT((part.applied - (correction - correction.dot(direction) * direction)).norm(), 1e-9);
}

TEST(DeterminedPart, MakesAnErrorLargerAsRarelyAsItSays) {
  RandomStream stream{7511};
  int applied = 0, larger = 0;
  for (int i = 0; i < 20000; ++i) {
    const double deviation = stream.real(1e-5, 1e-3);
    Eigen::Vector3d truth, noise;
    for (double& part : truth) part = 1e-3 * stream.normal();
    for (double& part : noise) part = deviation * stream.normal();
    const DeterminedPart part =
        determined_part(truth + noise, deviation * deviation * Eigen::Matrix3d::Identity(), 5e-5);
    applied += part.applied.isZero(0.0) ? 0 : 1;
    larger += (truth - part.applied).norm() > truth.norm() ? 1 : 0;
  }
  EXPECT_GT(applied, 5000);
  EXPECT_LT(larger, 20);
}

}  // namespace
}  // namespace demecal
