// A known length that the fitted model cannot have is named, whether it was fitted or not; right ones never are.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>
#include <utility>
#include <vector>

#include "closed_calibration/calibrated_model.hpp"
#include "data_check/check_data.hpp"
#include "fitting/touching_arm.hpp"

namespace demecal {
namespace {

using ::testing::HasSubstr;

constexpr double kSeatPlay_m = 5e-5;

/// Two blocks of two sockets 50 mm apart for calibration, another for acceptance alone.
KnownArm arm_at_blocks(std::uint64_t seed) {
  RandomStream stream{seed};
  KnownArm arm = perfect_arm(seven_joint_arm(), Frame::base);
  misbuild(arm, stream, {.joint_offset = true, .geometry = true});
  const Eigen::Vector3d gauge(0.0, 0.03, 0.04);
  const std::pair<const char*, Eigen::Vector3d> blocks[] = {
      {"left", {0.45, 0.25, 0.1}}, {"right", {0.35, -0.35, 0.35}}, {"back", {-0.2, 0.5, 0.25}}};
  for (const auto& [name, at_m] : blocks) {
    const bool accept = std::string(name) == "back";
    const PoseSet set = accept ? PoseSet::accept : PoseSet::calibration;
    touch(arm, stream, std::string(name) + "-0", at_m, 15, kSeatPlay_m, set);
    touch(arm, stream, std::string(name) + "-1", at_m + gauge, 15, kSeatPlay_m, set);
    arm.data.contacts.distances.push_back({std::string(name) + "-0", std::string(name) + "-1", gauge.norm(), 2e-5});
  }
  return arm;
}

std::vector<Finding> disagreeing(const DataSet& data) {
  const std::vector<std::size_t> poses = poses_of(data, PoseSet::calibration);
  const Fit fit = fit_declared(data, poses, kAll, nominal_robot(data));
  const FittedPosterior fitted = fitted_posterior(data, kAll, fit.robot, poses);
  const PredictionInterval interval{.quantile = 2.0, .noise_m = kSeatPlay_m};
  DataCheck check;
  check_fitted(data, fit.robot, fitted.posterior, interval, check);
  std::erase_if(check.findings, [](const Finding& one) { return one.kind != FindingKind::disagreeing_length; });
  return check.findings;
}

TEST(DisagreeingLengths, AreNoneWhereAllAreRight) {
  for (const std::uint64_t seed : {9601u, 9602u, 9603u, 9604u})
    EXPECT_TRUE(disagreeing(arm_at_blocks(seed).data).empty());
}

TEST(DisagreeingLengths, AreNamedWhereOneFittedIsWrong) {
  DataSet data = arm_at_blocks(9605).data;
  data.contacts.distances[0].length_m *= 1.04;
  const std::vector<Finding> found = disagreeing(data);
  ASSERT_FALSE(found.empty());
  EXPECT_THAT(found.front().sentence, HasSubstr("'left-0' and 'left-1' are"));
  EXPECT_THAT(found.front().sentence, HasSubstr("contradict each other"));
}

TEST(DisagreeingLengths, AreSaidToBeOfWhereTheyAreStated) {
  DataSet data = arm_at_blocks(9605).data;
  data.contacts.distances[0].length_m *= 1.04;
  EXPECT_THAT(disagreeing(data).front().sentence, HasSubstr("check all of contacts.distances, and the names"));
  data.contacts.distances[1].of_grid = true;
  EXPECT_THAT(disagreeing(data).front().sentence,
              HasSubstr("check all of contacts.distances, contacts.grids, and the names"));
  for (KnownDistance& known : data.contacts.distances) known.of_grid = true;
  EXPECT_THAT(disagreeing(data).front().sentence, HasSubstr("check all of contacts.grids, and the names"));
}

TEST(DisagreeingLengths, AreNamedWhereOneUnseenIsWrong) {
  DataSet data = arm_at_blocks(9606).data;
  data.contacts.distances[2].length_m *= 0.97;
  const std::vector<Finding> found = disagreeing(data);
  ASSERT_EQ(found.size(), 1u);
  EXPECT_THAT(found.front().sentence, HasSubstr("'back-0' and 'back-1' are"));
  EXPECT_THAT(found.front().sentence, HasSubstr("at the accept poses"));
}

/// Nothing but the description tells the scale of this arm: a length that it has otherwise is no surprise.
TEST(DisagreeingLengths, AreNoneWhereTheScaleIsNotKnown) {
  DataSet data = arm_at_blocks(9607).data;
  data.contacts.distances.erase(data.contacts.distances.begin(), data.contacts.distances.begin() + 2);
  data.contacts.distances[0].length_m *= 1.005;
  EXPECT_TRUE(disagreeing(data).empty());
}

/// Wrong by one factor, lengths agree among themselves, and with any arm that is longer by it.
TEST(DisagreeingLengths, AreNamedByTheLinksWhereAllAreWrongByOneFactor) {
  for (const double factor : {1.02, 0.98}) {
    DataSet data = arm_at_blocks(9608).data;
    for (KnownDistance& known : data.contacts.distances) known.length_m *= factor;
    const std::vector<Finding> found = disagreeing(data);
    ASSERT_EQ(found.size(), 1u) << factor;
    EXPECT_THAT(found.front().sentence,
                HasSubstr(factor > 1.0 ? "% longer than described" : "% shorter than described"));
    EXPECT_THAT(found.front().sentence, HasSubstr("Check contacts.distances, their unit"));
    for (KnownDistance& known : data.contacts.distances) known.of_grid = true;
    EXPECT_THAT(disagreeing(data).front().sentence, HasSubstr("Check contacts.grids, their unit"));
  }
}

}  // namespace
}  // namespace demecal
