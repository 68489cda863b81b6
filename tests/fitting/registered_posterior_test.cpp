// What is known of a tool's place once base and tool were fitted to a few poses: as much as is wrong in fact.
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "fitting/known_arm.hpp"
#include "parameters/posterior.hpp"

namespace demecal {
namespace {

/// Links as uncertain as misbuild() makes them.
Posterior of_misbuilt_links(const DataSet& data) {
  Posterior posterior;
  posterior.ids = free_parameters(data, {.joint_offset = true, .geometry = true});
  Eigen::VectorXd deviations(std::ssize(posterior.ids));
  for (std::size_t i = 0; i < posterior.ids.size(); ++i)
    deviations[static_cast<Eigen::Index>(i)] = posterior.ids[i].is_angle() ? 2e-3 : 1e-3;
  posterior.factor = deviations.asDiagonal();
  return posterior;
}

/// Mean squares at new poses over what is predicted, the fit being of so many poses.
double share_of_prediction(int poses, double noise_m, std::uint64_t seed) {
  constexpr int kTrials = 150, kNew = 10;
  RandomStream stream{seed};
  const PredictionInterval interval{.quantile = 2.8, .noise_m = noise_m};
  double squares_m2 = 0.0, predicted_m2 = 0.0;
  for (int trial = 0; trial < kTrials; ++trial) {
    KnownArm arm = perfect_arm(modified_arm(), Frame::base);
    misbuild(arm, stream, kAll);
    arm.truth.sensor_from_base.translation() = random_vector(stream, 0.01);
    arm.truth.tools[""].translation() += random_vector(stream, 0.01);
    measure(arm, stream, {.noise_m = noise_m}, poses + kNew);
    std::vector<std::size_t> fitted = all_poses(arm.data);
    fitted.resize(static_cast<std::size_t>(poses));
    FitOptions options;
    options.robust = false;
    const Fit fit = fit_registration(arm.data, fitted, kPlaced, nominal_robot(arm.data), options);
    const Posterior known = registered_posterior(of_misbuilt_links(arm.data), interval, fit.robot, arm.data, fitted);
    for (std::size_t i = fitted.size(); i < arm.data.poses.size(); ++i) {
      squares_m2 += std::pow(tool_error_m(fit.robot, arm.data, arm.data.poses[i]), 2);
      predicted_m2 += posterior_square_m2(known, fit.robot, arm.data, arm.data.poses[i]) + 3.0 * noise_m * noise_m;
    }
  }
  return squares_m2 / predicted_m2;
}

TEST(RegisteredPosterior, ErrsByTheNoiseOfFewPosesAndByWhatTheArmIsWrongBy) {
  EXPECT_NEAR(share_of_prediction(30, 1e-3, 2201), 1.0, 0.2) << "the arm's numbers count";
  EXPECT_NEAR(share_of_prediction(30, 0.02, 2202), 1.0, 0.2) << "the noise of thirty poses counts";
  EXPECT_NEAR(share_of_prediction(5, 1e-3, 2203), 1.0, 0.3) << "five poses";
}

}  // namespace
}  // namespace demecal
