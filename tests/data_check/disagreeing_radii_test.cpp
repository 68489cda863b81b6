// A stated radius that the data cannot have, since a better known length tells its scale, is named; right ones
// never are.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "data/stated_radius.hpp"
#include "data_check/check_data.hpp"
#include "fitting/touching_arm.hpp"

namespace demecal {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

constexpr double kBallPlay_m = 3e-5;

/// Two balls of 40 mm at a known distance, their radii stated with that much too many.
DataSet balls_stated(std::uint64_t seed, double too_many_m) {
  RandomStream stream{seed};
  KnownArm arm = perfect_arm(seven_joint_arm(), Frame::base);
  misbuild(arm, stream, {.joint_offset = true, .geometry = true});
  const Eigen::Vector3d near_m(0.45, 0.25, 0.1), far_m(0.35, -0.35, 0.35);
  touch_ball(arm, stream, "near", near_m, 0.04, 40, kBallPlay_m);
  touch_ball(arm, stream, "far", far_m, 0.04, 40, kBallPlay_m);
  arm.data.contacts.distances = {{"near", {}, 0.04 + too_many_m, kRadiusDeviation_m},
                                 {"far", {}, 0.04 + too_many_m, kRadiusDeviation_m},
                                 {"near", "far", (near_m - far_m).norm(), 2e-5}};
  return arm.data;
}

std::vector<std::string> named_lengths(const DataSet& data) {
  std::vector<std::string> sentences;
  for (const Finding& one : check_data(data).findings)
    if (one.kind == FindingKind::disagreeing_length) sentences.push_back(one.sentence);
  return sentences;
}

TEST(DisagreeingRadii, AreNoneWhereTheyAreRightToWhatIsStated) {
  for (const std::uint64_t seed : {9801u, 9802u}) EXPECT_TRUE(named_lengths(balls_stated(seed, 4e-5)).empty());
}

TEST(DisagreeingRadii, AreNamedWhereALengthTellsThemOtherwise) {
  const std::vector<std::string> named = named_lengths(balls_stated(9803, 1e-3));
  ASSERT_FALSE(named.empty());
  EXPECT_THAT(named.front(), AllOf(HasSubstr("The radius of 'far' is 41 mm as given, and 39.9"),
                                   HasSubstr("contacts.radii_mm"), HasSubstr("contacts.radii_sigma_mm")));
}

TEST(DisagreeingRadii, AreSaidToBeDiametersAndNoPoseIsBlamedForThem) {
  const std::vector<Finding> found = check_data(balls_stated(9804, 0.04)).findings;
  ASSERT_EQ(found.size(), 2u);
  for (const Finding& one : found) {
    EXPECT_EQ(one.kind, FindingKind::disagreeing_length);
    EXPECT_THAT(one.sentence, HasSubstr("What is given seems to be the diameter."));
  }
}

}  // namespace
}  // namespace demecal
