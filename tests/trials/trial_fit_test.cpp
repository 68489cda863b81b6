// The quick fit finds base, tool and links of a simulated arm, and a few wrong rows do not move it.
#include "trials/trial_fit.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "kinematics/forward.hpp"
#include "mistaken_case.hpp"
#include "parameters/declared_model.hpp"
#include "random/random_stream.hpp"

namespace demecal {
namespace {

Trial exact_trial(std::uint64_t seed) {
  RandomStream random{seed};
  Trial trial;
  trial.chain = bench::mistaken_arms(DEMECAL_SOURCE_DIR "/configs/robots")[3].chain;
  trial.tools_m = {trial.chain.tool_m};
  Chain truth = trial.chain;
  for (Joint& joint : truth.joints) {
    joint.theta_rad += 2e-3 * random.normal();
    joint.a_m += 5e-4 * random.normal();
  }
  const Eigen::Isometry3d base =
      Eigen::Translation3d(1.0, -2.0, 0.5) * Eigen::AngleAxisd(2.2, Eigen::Vector3d(1, 2, 3).normalized());
  const Eigen::Vector3d tool_m = trial.chain.tool_m + Eigen::Vector3d(0.15, -0.1, 0.05);
  for (int i = 0; i < 60; ++i) {
    JointVector joints(truth.size());
    for (int j = 0; j < truth.size(); ++j) joints[j] = random.real(-1.5, 1.5);
    trial.rows.push_back({joints, base * (forward(truth, joints) * tool_m), 0, 0, static_cast<std::size_t>(i)});
  }
  return trial;
}

/// The largest change of a link parameter, in standard deviations of how arms are made.
double largest_change(const TrialFit& fit, const Trial& trial) {
  double largest = 0.0;
  for (std::size_t joint = 0; joint < fit.chain.joints.size(); ++joint) {
    for (int i = 0; i < kLinkParameters; ++i) {
      const auto parameter = static_cast<LinkParameter>(i);
      const bool is_length = parameter == LinkParameter::d || parameter == LinkParameter::a;
      const double change =
          fit.chain.joints[joint].parameter(parameter) - trial.chain.joints[joint].parameter(parameter);
      largest = std::max(largest, std::abs(change) / (is_length ? kMakersDeviation_m : kMakersDeviation_rad));
    }
  }
  return largest;
}

TEST(TrialFit, FindsAnExactArmFromFarOff) {
  for (const std::uint64_t seed : {1, 2, 3}) {
    const Trial trial = exact_trial(seed);
    const TrialFit fit = fit_arm(trial, fit_base_and_tools(trial));
    EXPECT_LT(fit.median_m, 2e-5) << seed;
    EXPECT_LT(largest_change(fit, trial), 3.0) << seed;
  }
}

/// An arm along a smooth path, its tool unknown.
Trial smooth_trial(std::uint64_t seed) {
  Trial trial = exact_trial(seed);
  RandomStream random{seed, 5};
  const Eigen::Vector3d tool_m = trial.tools_m[0] + Eigen::Vector3d(0.15, -0.1, 0.05);
  trial.tools_m[0].setZero();
  const Eigen::Isometry3d base(Eigen::Translation3d(1.0, -2.0, 0.5) *
                               Eigen::AngleAxisd(2.2, Eigen::Vector3d(1, 2, 3).normalized()));
  std::vector<double> phases;
  for (int joint = 0; joint < trial.chain.size(); ++joint) phases.push_back(random.real(0.0, 6.0));
  for (std::size_t i = 0; i < trial.rows.size(); ++i) {
    TrialRow& row = trial.rows[i];
    for (int joint = 0; joint < trial.chain.size(); ++joint)
      row.joints[joint] =
          1.4 * std::sin(0.01 * static_cast<double>(i) * (0.9 + 0.4 * joint) + phases[static_cast<std::size_t>(joint)]);
    row.point_m = base * (forward(trial.chain, row.joints) * tool_m);
  }
  return trial;
}

TEST(TrialFit, ASearchFindsTheToolAlongASmoothPath) {
  int missed = 0;
  for (std::uint64_t seed = 70; seed < 90; ++seed) {
    const Trial trial = smooth_trial(seed);
    const TrialFit placed = fit_base_and_tools(trial), searched = search_base_and_tools(trial, placed);
    missed += placed.median_m > 1e-3 ? 1 : 0;
    EXPECT_LT(searched.median_m, 1e-4) << seed << " " << placed.median_m;
  }
  EXPECT_GT(missed, 0) << "the registration of the nominal tool's points would do";
}

TEST(TrialFit, IsNotMovedByAFewWrongRows) {
  for (const std::uint64_t seed : {4, 5, 6}) {
    Trial trial = exact_trial(seed);
    for (const std::size_t wrong : {3u, 17u, 20u, 41u, 55u, 59u})
      trial.rows[wrong].point_m += Eigen::Vector3d(0.3, 1.0, -0.2);
    const TrialFit fit = fit_arm(trial, fit_base_and_tools(trial));
    EXPECT_LT(fit.median_m, 2e-5) << seed;
    EXPECT_GT(fit.error_m[17], 1.0) << seed;
  }
}

TEST(TrialFit, IsSureWherePosesWereAndUnsureWhereTheyWereNot) {
  Trial trial = exact_trial(8);
  for (TrialRow& row : trial.rows) row.joints[1] = 0.3;
  RandomStream random{8, 2};
  for (TrialRow& row : trial.rows) {
    row.point_m = forward(trial.chain, row.joints) * trial.tools_m[0];
    for (double& value : row.point_m) value += 5e-5 * random.normal();
  }
  const TrialFit fit = fit_arm(trial, fit_base_and_tools(trial));
  EXPECT_NEAR(fit.deviation_m, 5e-5, 1.5e-5);
  TrialRow there = trial.rows[5];
  EXPECT_LT(std::sqrt(fit.prediction_covariance(there).trace()), 1e-4);
  there.joints[1] = 1.3;
  EXPECT_GT(std::sqrt(fit.prediction_covariance(there).trace()), 1e-3);
}

TEST(TrialFit, TakesNoiseForWhatItIsHoweverFewTheRows) {
  double squares = 0.0;
  int count = 0;
  for (std::uint64_t seed = 20; seed < 60; ++seed) {
    Trial trial = exact_trial(seed);
    trial.rows.resize(14);
    RandomStream random{seed, 2};
    for (TrialRow& row : trial.rows)
      for (double& value : row.point_m) value += 1e-4 * random.normal();
    const TrialFit fit = fit_arm(trial, fit_base_and_tools(trial));
    squares += fit.deviation_m * fit.deviation_m;
    ++count;
    EXPECT_GT(fit.deviation_m, 1e-5) << seed;
  }
  EXPECT_GT(std::sqrt(squares / count), 5e-5);
}

TEST(TrialFit, KeepsLinksNearTheirDescriptionWhereNothingFits) {
  Trial trial = exact_trial(7);
  for (TrialRow& row : trial.rows) row.joints[2] *= -1.0;
  const TrialFit fit = fit_arm(trial, fit_base_and_tools(trial));
  EXPECT_GT(fit.median_m, 0.02);
  EXPECT_LT(largest_change(fit, trial), 20.0);
}

/// An arm with two upright joints, a slide that hangs upside down but for `tilt_rad`, and a joint about it, measured by
/// somebody who counts the slide the other way.
Trial hanging_slide(double tilt_rad, std::uint64_t seed) {
  RandomStream random{seed};
  Trial trial;
  trial.chain.joints.resize(4);
  trial.chain.joints[0].a_m = 0.325;
  trial.chain.joints[0].d_m = 0.387;
  trial.chain.joints[1].a_m = 0.275;
  trial.chain.joints[1].alpha_rad = std::numbers::pi + tilt_rad;
  trial.chain.joints[2].type = JointType::prismatic;
  trial.tools_m = {{0.05, 0.03, 0.1}};
  const Eigen::Isometry3d base =
      Eigen::Translation3d(2.5, -0.6, 0.3) * Eigen::AngleAxisd(1.7, Eigen::Vector3d(0.05, 0.17, 1.0).normalized());
  for (std::size_t i = 0; i < 60; ++i) {
    JointVector joints(4);
    for (double& joint : joints) joint = random.real(-2.2, 2.2);
    joints[2] = random.real(0.0, 0.2);
    Eigen::Vector3d point_m = base * (forward(trial.chain, joints) * trial.tools_m.front());
    for (double& coordinate : point_m) coordinate += 3e-5 * random.normal();
    joints[2] *= -1.0;
    trial.rows.push_back({joints, point_m, 0, 0, i});
  }
  return trial;
}

TEST(TrialFit, CountsNoFewerParametersThanNoneAndNoMoreThanThereAre) {
  for (const double tilt_rad : {0.0, 1e-16, 2.1e-13, 1.7e-12, 1e-10, 1.7e-8, 1e-6}) {
    for (const std::uint64_t seed : {1, 2, 3, 4}) {
      const Trial trial = hanging_slide(tilt_rad, seed);
      const TrialFit placed = fit_base_and_tools(trial);
      for (const TrialFit& fit : {placed, fit_arm(trial, placed), fit_arm_to_all(trial, placed)}) {
        EXPECT_GE(fit.effective_parameters, 0.0) << tilt_rad;
        EXPECT_LE(fit.effective_parameters, 6.0 + 3.0 + 16.0) << tilt_rad;
        EXPECT_TRUE(std::isfinite(fit.deviation_m)) << tilt_rad;
      }
    }
  }
}

}  // namespace
}  // namespace demecal
