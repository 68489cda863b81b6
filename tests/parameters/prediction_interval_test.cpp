// Quantiles of scores: what split conformal prediction promises, for every distribution and with repeats.
#include "parameters/posterior.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <numeric>

#include "random/random_stream.hpp"

namespace demecal {
namespace {

std::vector<std::size_t> alone(std::size_t scores) {
  std::vector<std::size_t> groups(scores);
  std::iota(groups.begin(), groups.end(), std::size_t{0});
  return groups;
}

TEST(ConformalQuantile, IsTheOrderStatisticOfSplitConformalPrediction) {
  std::vector<double> scores(39);
  std::iota(scores.rbegin(), scores.rend(), 1.0);
  EXPECT_EQ(conformal_quantile(scores, alone(39), 0.95), 38.0);  // ceil(40 * 0.95)
  scores.resize(19);
  EXPECT_EQ(conformal_quantile(scores, alone(19), 0.95), 39.0);  // the largest of those left
  scores.resize(18);
  EXPECT_TRUE(std::isinf(conformal_quantile(scores, alone(18), 0.95)));
}

TEST(ConformalQuantile, CountsRepeatsOfAPoseOnce) {
  std::vector<double> scores(39);
  std::iota(scores.begin(), scores.end(), 1.0);
  std::vector<std::size_t> groups = alone(39);
  for (int repeat = 0; repeat < 200; ++repeat) {
    scores.push_back(100.0);
    groups.push_back(38);
  }
  EXPECT_EQ(conformal_quantile(scores, groups, 0.95), 38.0);
  EXPECT_TRUE(std::isinf(conformal_quantile(scores, std::vector<std::size_t>(scores.size(), 0), 0.95)));
}

TEST(ConformalQuantile, HoldsItsShareOfNewScoresOfAnyDistribution) {
  RandomStream random{511};
  int inside = 0;
  constexpr int kTrials = 4000;
  for (int trial = 0; trial < kTrials; ++trial) {
    const auto draw = [&] { return std::abs(random.normal() / (0.1 + std::abs(random.normal()))); };
    std::vector<double> scores(39);
    for (double& score : scores) score = draw();
    inside += draw() <= conformal_quantile(scores, alone(39), 0.95) ? 1 : 0;
  }
  EXPECT_NEAR(inside, 0.95 * kTrials, 4.0 * std::sqrt(0.05 * 0.95 * kTrials));
}

TEST(NormalQuantile, HoldsItsShareWhereScoresAreFewAndNormal) {
  RandomStream random{512};
  int inside = 0;
  constexpr int kTrials = 4000;
  for (int trial = 0; trial < kTrials; ++trial) {
    const auto draw = [&] { return Eigen::Vector3d(random.normal(), random.normal(), random.normal()).norm(); };
    std::vector<double> scores(6);
    for (double& score : scores) score = draw();
    inside += draw() <= normal_quantile_of_scores(scores, alone(6), 3, 0.95) ? 1 : 0;
  }
  EXPECT_NEAR(inside, 0.95 * kTrials, 4.0 * std::sqrt(0.05 * 0.95 * kTrials));
}

/// An instrument that measures two axes twice as badly as is usual, and one as usual.
TEST(NoiseSquare, IsThatOfThePosesOwnUncertainty) {
  PredictionInterval interval;
  interval.noise_m = 1e-4;
  interval.model_error_m = 3e-5;
  MeasuredPose pose;
  EXPECT_NEAR(noise_square_m2(interval, pose), 3.0 * (1e-8 + 9e-10), 1e-16);
  const Eigen::Matrix3d turn = Eigen::AngleAxisd(0.8, Eigen::Vector3d(1, 2, 3).normalized()).toRotationMatrix();
  pose.position_whitening = turn * Eigen::Vector3d(0.5, 0.5, 1.0).asDiagonal() * turn.transpose();
  EXPECT_NEAR(noise_square_m2(interval, pose), 9e-8 + 3.0 * 9e-10, 1e-16);
}

TEST(NoiseSquare, IsThatOfThePosesStation) {
  PredictionInterval interval;
  interval.noise_m = 1e-4;
  interval.model_error_m = 3e-5;
  interval.station_noise_m = {{"coarse", 4e-4}};
  MeasuredPose pose;
  pose.station = "fine";
  EXPECT_NEAR(noise_square_m2(interval, pose), 3.0 * (1e-8 + 9e-10), 1e-16);
  pose.station = "coarse";
  EXPECT_NEAR(noise_square_m2(interval, pose), 3.0 * (16e-8 + 9e-10), 1e-16);
}

}  // namespace
}  // namespace demecal
