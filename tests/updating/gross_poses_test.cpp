// One pose among few new ones that is a gross error is named, and none where there is none.
#include "updating/gross_poses.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "lacking_numbers.hpp"
#include "prediction/measurement.hpp"
#include "updating/update.hpp"

namespace demecal {
namespace {

constexpr std::size_t kNewPoses = 20;

struct MovedWrist {
  DataSet data;
  CalibratedModel model;
  CorrectedRobot now;

  Update update() const {
    const std::vector<std::size_t> poses = poses_of(data, PoseSet::calibration);
    const DeclaredModel places{.registration = true, .tool = true};
    return updated(model, fit_registration(data, poses, places, model.robot).robot, data, poses, model.declared);
  }
};

/// An arm whose second zero has changed.
MovedWrist moved_wrist(std::uint64_t seed) {
  MovedWrist arm{{}, model_of_wrist(measured_wrist(true_wrist(seed), 60, 0, seed)), true_wrist(seed)};
  arm.now.chain.joints[1].theta_rad += 5e-4;
  arm.data = measured_wrist(arm.now, kNewPoses, 60, 600 + seed);
  return arm;
}

TEST(GrossPoses, AreNoneAmongPosesThatScatterAsUsual) {
  int named_falsely = 0;
  for (std::uint64_t seed = 21; seed <= 30; ++seed) named_falsely += !moved_wrist(seed).update().gross.empty();
  EXPECT_EQ(named_falsely, 0);
}

TEST(GrossPoses, IsTheOneOfTwentyThatIs) {
  for (std::uint64_t seed = 21; seed <= 23; ++seed) {
    const MovedWrist right = moved_wrist(seed);
    const double without_mm =
        error_figures(right.update().robot, right.data, poses_of(right.data, PoseSet::validation)).rms_mm;
    for (const double error_m : {1e-3, 5e-3, 3e-2}) {
      MovedWrist arm = right;
      RandomStream random{9304, seed};
      const std::size_t at = random.index(kNewPoses);
      *arm.data.poses[at].position_m +=
          error_m * Eigen::Vector3d(random.normal(), random.normal(), random.normal()).normalized();
      const Update update = arm.update();
      EXPECT_THAT(update.gross, testing::ElementsAre(at)) << seed << " " << error_m;
      EXPECT_THAT(update.sentences, testing::Contains(testing::HasSubstr("gross errors")));
      EXPECT_LT(error_figures(update.robot, arm.data, poses_of(arm.data, PoseSet::validation)).rms_mm, 1.5 * without_mm)
          << seed << " " << error_m;
    }
  }
}

TEST(GrossPoses, IsTheOneOfSixToTwelveThatIs) {
  for (std::uint64_t seed = 41; seed <= 45; ++seed) {
    MovedWrist arm = moved_wrist(seed);
    for (const int poses : {6, 8, 12}) {
      arm.data = measured_wrist(arm.now, poses, 0, 900 + seed);
      EXPECT_THAT(arm.update().gross, testing::IsEmpty()) << poses << " " << seed;
      RandomStream random{9305, seed};
      const std::size_t at = random.index(static_cast<std::size_t>(poses));
      *arm.data.poses[at].position_m +=
          3e-3 * Eigen::Vector3d(random.normal(), random.normal(), random.normal()).normalized();
      EXPECT_THAT(arm.update().gross, testing::ElementsAre(at)) << poses << " " << seed;
    }
  }
}

}  // namespace
}  // namespace demecal
