// What a model found before knows of a joint follows how many of its poses stood where.
#include "updating/known_places.hpp"

#include <gtest/gtest.h>

namespace demecal {
namespace {

CalibratedModel counted(int poses_from, int poses_to, int count) {
  CalibratedModel model;
  model.measured = {{-1.0, 1.0}};
  model.pose_counts[0].assign(kTurnSteps, 0);
  for (int step = poses_from; step < poses_to; ++step) model.pose_counts[0][static_cast<std::size_t>(step)] = count;
  return model;
}

TEST(KnownPlaces, AreWherePosesStood) {
  const auto places = known_places(counted(10, 20, 5), 0);
  ASSERT_FALSE(places.empty());
  for (const KnownPlace& place : places) {
    EXPECT_GE(place.theta_rad, 10 * kTurnStep_rad);
    EXPECT_LT(place.theta_rad, 20 * kTurnStep_rad);
  }
  EXPECT_TRUE(known_places(counted(0, 0, 0), 0).empty());
}

TEST(KnownPlaces, AreKnownTheBetterTheMorePosesStoodThere) {
  double last = 1.0;
  for (const int count : {1, 3, 10, 100, 10000}) {
    const double variance = known_places(counted(3, 5, count), 0).front().variance;
    EXPECT_LT(variance, last);
    last = variance;
  }
}

TEST(KnownPlaces, AreTheWholeRangeOfModelsThatDoNotSay) {
  CalibratedModel model = counted(10, 20, 5);
  model.pose_counts.clear();
  const auto places = known_places(model, 0);
  EXPECT_NEAR(places.front().theta_rad, -1.0, 1e-12);
  EXPECT_NEAR(places.back().theta_rad, 1.0, 0.04);
  for (const KnownPlace& place : places) EXPECT_EQ(place.variance, places.front().variance);
}

}  // namespace
}  // namespace demecal
