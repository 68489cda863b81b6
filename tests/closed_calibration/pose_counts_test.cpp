// How often each joint stands where in its turn, whole turns aside.
#include <gtest/gtest.h>

#include <algorithm>
#include <numbers>
#include <numeric>

#include "calibration/erring_arm.hpp"
#include "closed_calibration/calibrated_model.hpp"

namespace demecal {
namespace {

constexpr double kTurn_rad = 2.0 * std::numbers::pi;

TEST(PoseCounts, StepsOfATurnAreCountedFromZeroWholeTurnsAside) {
  for (const double angle : {0.01, 1.0, 3.0, 6.2}) {
    for (const int turns : {-2, -1, 0, 1})
      EXPECT_EQ(turn_step(angle + kTurn_rad * turns), static_cast<std::size_t>(angle / kTurnStep_rad));
  }
  EXPECT_LT(turn_step(-1e-18), static_cast<std::size_t>(kTurnSteps));
}

TEST(PoseCounts, CountEveryFittedPoseOfEveryJointOnce) {
  DataSet data = measure(true_puma({"", "", "", "", "", ""}), 60, 0.0, 93, false);
  for (MeasuredPose& pose : data.poses) pose.set = PoseSet::calibration;
  data.poses.front().set = PoseSet::accept;
  const auto counts = pose_counts(data, Calibration{});
  ASSERT_EQ(counts.size(), static_cast<std::size_t>(data.robot.chain.size()));
  for (const auto& [joint, steps] : counts) {
    EXPECT_EQ(std::accumulate(steps.begin(), steps.end(), 0), 59) << joint;
    for (std::size_t step = 0; step < steps.size(); ++step) {
      const auto within = [&](const MeasuredPose& pose) {
        return pose.set == PoseSet::calibration && turn_step(pose.joints[joint]) == step;
      };
      EXPECT_EQ(steps[step], std::ranges::count_if(data.poses, within)) << joint << " " << step;
    }
  }
}

}  // namespace
}  // namespace demecal
