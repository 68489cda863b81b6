// An old model and few new poses: better than base and tool alone where something has changed, and no worse where not.
#include <gtest/gtest.h>

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

}  // namespace
}  // namespace demecal
