// Stretches of a joint in which no pose stands are told where that is no chance.
#include <gtest/gtest.h>

#include "calibration/erring_arm.hpp"
#include "closed_calibration/calibrated_model.hpp"

namespace demecal {
namespace {

/// 60 poses whose joint 2 is where `place` puts a number from 0 to 1.
template <typename Place>
DataSet standing(std::uint64_t seed, const Place& place) {
  DataSet data = measure(true_puma({"", "", "", "", "", ""}), 60, 0.0, seed, false);
  RandomStream random{seed, 4713};
  for (MeasuredPose& pose : data.poses) {
    pose.set = PoseSet::calibration;
    pose.joints[1] = place(random.real(0.0, 1.0));
  }
  return data;
}

TEST(MeasuredGaps, AreStretchesThatChanceDoesNotLeave) {
  const DataSet data = standing(91, [](double share) { return share < 0.5 ? -1.3 + 1.2 * share : 0.4 + 1.2 * share; });
  const auto gaps = measured_gaps(data, Calibration{});
  ASSERT_TRUE(gaps.contains(1));
  ASSERT_EQ(gaps.at(1).size(), 1u);
  EXPECT_NEAR(gaps.at(1)[0].lower, -0.7, 0.1);
  EXPECT_NEAR(gaps.at(1)[0].upper, 1.0, 0.1);
}

TEST(MeasuredGaps, AreNoneInRandomPosesNorBetweenAFewSteps) {
  int found = 0;
  for (std::uint64_t seed = 100; seed < 200; ++seed)
    found += measured_gaps(standing(seed, [](double share) { return -1.3 + 2.6 * share; }), Calibration{}).contains(1);
  EXPECT_LE(found, 3);
  const DataSet steps = standing(92, [](double share) { return -1.2 + 0.6 * std::floor(5.0 * share); });
  EXPECT_FALSE(measured_gaps(steps, Calibration{}).contains(1));
}

}  // namespace
}  // namespace demecal
