// How often each joint stands where in its turn, whole turns aside; and which poses a model knows again.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
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

TEST(PoseMarks, KnowPosesOfTheModelAgainAndNoOthers) {
  DataSet data = measure(true_puma({"", "", "", "", "", ""}), 90, 1e-5, 94, false);
  for (std::size_t i = 0; i < 90; ++i)
    data.poses[i].set = std::array{PoseSet::calibration, PoseSet::validation, PoseSet::accept}[i % 3];
  CalibratedModel model;
  model.pose_marks = pose_marks(data);
  ASSERT_EQ(model.pose_marks.size(), kPoseMarks);
  EXPECT_TRUE(std::ranges::is_sorted(model.pose_marks));
  DataSet shuffled = data;
  for (MeasuredPose& pose : shuffled.poses) pose.set = PoseSet::accept, pose.pose_id = "renamed";
  std::ranges::reverse(shuffled.poses);
  EXPECT_EQ(marked_poses(model, shuffled).size(), kPoseMarks);
  for (const std::size_t pose : marked_poses(model, data)) EXPECT_NE(data.poses[pose].set, PoseSet::accept);
  const DataSet others = measure(true_puma({"", "", "", "", "", ""}), 90, 1e-5, 95, false);
  EXPECT_TRUE(marked_poses(model, others).empty());
  DataSet all = data;
  all.poses.insert(all.poses.end(), others.poses.begin(), others.poses.end());
  EXPECT_EQ(marks_of_both(pose_marks(data), pose_marks(others)), pose_marks(all));
}

}  // namespace
}  // namespace demecal
