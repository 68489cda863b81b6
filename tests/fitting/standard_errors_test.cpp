// Standard errors and scatter against what repeated measurements of simulated arms show.
#include <gtest/gtest.h>

#include <cmath>

#include "fitting/known_arm.hpp"

namespace demecal {
namespace {

/// Mean and spread of every estimate over many fits, and the mean standard error that the fits gave.
struct Repeated {
  std::vector<double> mean, spread, standard_error;
};

Repeated repeat_fit(KnownArm arm, RandomStream& stream, const Instrument& instrument, int trials,
                    const FitOptions& options) {
  Eigen::MatrixXd values, errors;
  for (int trial = 0; trial < trials; ++trial) {
    arm.data.poses.clear();
    RandomStream same_poses{502};
    for (int i = 0; i < 40; ++i) measure(arm, stream, instrument, random_joints(same_poses, arm.data.robot.chain));
    const Fit fit = fit_declared(arm.data, all_poses(arm.data), kAll, arm.truth, options);
    const auto n = static_cast<Eigen::Index>(fit.estimates.size());
    values.conservativeResize(n, trial + 1);
    errors.conservativeResize(n, trial + 1);
    for (Eigen::Index i = 0; i < n; ++i) {
      values(i, trial) = fit.estimates[static_cast<std::size_t>(i)].value;
      errors(i, trial) = fit.estimates[static_cast<std::size_t>(i)].standard_error;
    }
  }
  Repeated repeated;
  for (Eigen::Index i = 0; i < values.rows(); ++i) {
    const double mean = values.row(i).mean();
    repeated.mean.push_back(mean);
    repeated.spread.push_back(std::sqrt((values.row(i).array() - mean).square().sum() / (trials - 1)));
    repeated.standard_error.push_back(errors.row(i).mean());
  }
  return repeated;
}

class StandardErrors : public ::testing::TestWithParam<bool> {};
INSTANTIATE_TEST_SUITE_P(PlainAndRobust, StandardErrors, ::testing::Bool());

TEST_P(StandardErrors, AreTheSpreadOfRepeatedFits) {
  constexpr int kTrials = 120;  // spreads are known to 1 part in sqrt(2 * 120), 6.5 %: four of these are allowed
  RandomStream stream{501};
  KnownArm arm = perfect_arm(parallel_arm(), Frame::sensor);
  misbuild(arm, stream, kAll);
  arm.truth.sensor_from_base = far_pose(stream);
  const Instrument instrument{.noise_m = 1e-4, .noise_rad = 2e-4, .orientation = true};
  const FitOptions options{.starts = 0, .robust = GetParam(), .prior_m = 0, .prior_rad = 0};
  const Repeated repeated = repeat_fit(arm, stream, instrument, kTrials, options);
  int identified = 0;
  for (std::size_t i = 0; i < repeated.spread.size(); ++i) {
    if (repeated.standard_error[i] < 1e-9) continue;
    ++identified;
    EXPECT_NEAR(repeated.spread[i] / repeated.standard_error[i], 1.0, 0.26) << i;
  }
  EXPECT_EQ(identified, 30);
}

TEST_P(StandardErrors, OfScatterSeparatePositionFromOrientation) {
  RandomStream stream{503};
  KnownArm arm = perfect_arm(parallel_arm(), Frame::sensor);
  misbuild(arm, stream, kAll);
  measure(arm, stream, {.noise_m = 5e-5, .noise_rad = 1e-3, .orientation = true}, 400);
  const Fit fit = fit_all(arm, kAll, {.robust = GetParam()});
  EXPECT_NEAR(fit.sigma_position_m, 5e-5, 5e-6);
  EXPECT_NEAR(fit.sigma_orientation_rad, 1e-3, 1e-4);
}

TEST(StandardErrorsOfFewPoses, CountTheParametersThatWereFitted) {
  double squares = 0.0;
  constexpr int kTrials = 60;
  for (std::uint64_t trial = 0; trial < kTrials; ++trial) {
    RandomStream stream{504, trial};
    KnownArm arm = perfect_arm(parallel_arm(), Frame::base);
    measure(arm, stream, {.noise_m = 1e-4}, 14);  // 42 rows for 24 parameters
    const Fit fit = fit_all(arm, {.joint_offset = true, .geometry = true}, {.robust = false});
    squares += std::pow(fit.sigma_position_m, 2) / kTrials;
  }
  EXPECT_NEAR(std::sqrt(squares), 1e-4, 1e-5);
}

}  // namespace
}  // namespace demecal
