// An old model and few new poses: better than base and tool alone where something has changed, and no worse where not.
#include <gtest/gtest.h>

#include <string>
#include <utility>
#include <vector>

#include "fitting/stations.hpp"
#include "lacking_numbers.hpp"
#include "prediction/measurement.hpp"
#include "updating/update.hpp"

namespace demecal {
namespace {

double error_mm(const CorrectedRobot& robot, const DataSet& data) {
  return error_figures(robot, data, poses_of(data, PoseSet::validation)).rms_mm;
}

struct Outcome {
  double placed_mm, updated_mm;
};

Outcome outcome_of(std::uint64_t seed, double offset_rad) {
  const CalibratedModel model = model_of_wrist(measured_wrist(true_wrist(seed), 60, 30, seed));
  CorrectedRobot now = true_wrist(seed);
  now.chain.joints[1].theta_rad += offset_rad;
  now.sensor_from_base.translation() += Eigen::Vector3d(0.3, -0.4, 0.2);
  const DataSet data = measured_wrist(now, 12, 60, 500 + seed);
  const std::vector<std::size_t> poses = poses_of(data, PoseSet::calibration);
  const CorrectedRobot placed = fit_registration(data, poses, {.registration = true, .tool = true}, model.robot).robot;
  return {error_mm(placed, data), error_mm(updated(model, placed, data, poses, model.declared).robot, data)};
}

TEST(Update, FindsWhatHasChangedInTwelvePoses) {
  for (std::uint64_t seed = 1; seed <= 3; ++seed) {
    const Outcome outcome = outcome_of(seed, 5e-4);
    EXPECT_LT(outcome.updated_mm, 0.6 * outcome.placed_mm) << seed;
  }
}

TEST(Update, LeavesAnArmAloneThatIsAsItWas) {
  for (std::uint64_t seed = 1; seed <= 3; ++seed) {
    const Outcome outcome = outcome_of(seed, 0.0);
    EXPECT_LT(outcome.updated_mm, 1.1 * outcome.placed_mm) << seed;
  }
}

struct OfTheSameInstrument {
  double mended_mm, updated_mm;  ///< by the old model with what jumped, and by the updated one
  Update update;
};

/// The instrument stands where it stood: the zero of a joint alone is another.
OfTheSameInstrument with_zero_moved(std::uint64_t seed, std::size_t joint, double offset_rad) {
  const CalibratedModel model = model_of_wrist(measured_wrist(true_wrist(seed), 60, 30, seed));
  CorrectedRobot now = true_wrist(seed), mended = model.robot;
  now.chain.joints[joint].theta_rad += offset_rad;
  mended.chain.joints[joint].theta_rad += offset_rad;
  const DataSet data = measured_wrist(now, 14, 100, 700 + seed);
  const std::vector<std::size_t> poses = poses_of(data, PoseSet::calibration);
  const CorrectedRobot placed = fit_registration(data, poses, {.registration = true, .tool = true}, model.robot).robot;
  Update update = updated(model, placed, data, poses, model.declared);
  const double updated_mm = error_mm(update.robot, data);
  return {error_mm(mended, data), updated_mm, std::move(update)};
}

TEST(Update, OfOneZeroLeavesBaseAndToolWhereTheyStand) {
  for (std::uint64_t seed = 1; seed <= 3; ++seed) {
    const std::size_t joint = 1 + seed % 3;
    const OfTheSameInstrument outcome = with_zero_moved(seed, joint, 1e-3);
    EXPECT_LT(outcome.updated_mm, 1.15 * outcome.mended_mm) << seed;
    ASSERT_TRUE(outcome.update.moved) << seed;
    EXPECT_FALSE(outcome.update.moved->base || outcome.update.moved->tool) << seed;
    EXPECT_EQ(outcome.update.moved->zeros, std::vector<int>{static_cast<int>(joint)}) << seed;
    const std::string zero = "The zero of joint " + std::to_string(joint + 1) + " is off by ";
    EXPECT_EQ(outcome.update.sentences.back().rfind(zero, 0), 0U) << outcome.update.sentences.back();
  }
}

TEST(Update, OfARobotAsItWasIsNoWorseThanTheOldModel) {
  for (std::uint64_t seed = 1; seed <= 3; ++seed) {
    const OfTheSameInstrument outcome = with_zero_moved(seed, 1, 0.0);
    EXPECT_LT(outcome.updated_mm, 1.1 * outcome.mended_mm) << seed;
  }
}

TEST(Update, BelievesAPreciseInstrumentMoreThanACoarseOne) {
  constexpr double kTimesCoarser = 15.0;
  for (std::uint64_t seed = 11; seed <= 13; ++seed) {
    const CalibratedModel model = model_of_wrist(measured_wrist(true_wrist(seed), 60, 30, seed));
    CorrectedRobot now = true_wrist(seed);
    now.chain.joints[1].theta_rad += 5e-4;
    DataSet precise = measured_wrist(now, 20, 0, 600 + seed), coarse = measured_wrist(now, 20, 0, 700 + seed);
    precise.file = "precise";
    coarse.file = "coarse";
    RandomStream random{9302, seed};
    for (MeasuredPose& pose : coarse.poses)
      *pose.position_m +=
          kTimesCoarser * kMeasured_m * Eigen::Vector3d(random.normal(), random.normal(), random.normal());
    const DataSet data = joined_stations({precise, coarse}, StationTools::shared);
    const std::vector<std::size_t> poses = poses_of(data, PoseSet::calibration);
    const CorrectedRobot placed =
        fit_registration(data, poses, {.registration = true, .tool = true}, model.robot).robot;
    const RowScales scales = updated(model, placed, data, poses, model.declared).fitted.scatter;
    const double ratio = scales.of(data.poses.back(), kPosition) / scales.of(data.poses.front(), kPosition);
    EXPECT_GT(ratio, kTimesCoarser / 3) << seed;
    EXPECT_LT(ratio, kTimesCoarser * 3) << seed;
  }
}

}  // namespace
}  // namespace demecal
