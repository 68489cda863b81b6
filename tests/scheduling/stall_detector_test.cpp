// Which islands ought to make progress and do not.
#include "scheduling/assignment.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace demecal {
namespace {

using std::chrono::milliseconds;
using ::testing::ElementsAre;
using ::testing::IsEmpty;

constexpr milliseconds kPatience{100};
constexpr IslandKey kFirst{0, 0}, kSecond{0, 1}, kThird{0, 2};

StallDetector::Time moment(int time_ms) {
  return StallDetector::Time{} + milliseconds(time_ms);
}

/// Three islands in a ring: each takes in what the one before it sends.
Archipelago ring(bool asynchronous = false) {
  Archipelago archipelago;
  archipelago.joints = {0};
  archipelago.demes_per_joint = 3;
  archipelago.asynchronous = asynchronous;
  return archipelago;
}

TEST(StallDetector, IslandsThatNeverBeganAreStalled) {
  const StallDetector detector(ring(), moment(0));
  EXPECT_THAT(detector.stalled(moment(99), kPatience), IsEmpty());
  EXPECT_THAT(detector.stalled(moment(101), kPatience), ElementsAre(kFirst, kSecond, kThird));
}

TEST(StallDetector, AnIslandThatWaitsForItsSourceIsNot) {
  StallDetector detector(ring(), moment(0));
  for (const IslandKey island : {kFirst, kSecond}) detector.reached(island, 1, moment(1));
  // The first waits for the third, and the second has all it needs.
  EXPECT_THAT(detector.stalled(moment(500), kPatience), ElementsAre(kSecond, kThird));
}

TEST(StallDetector, InAnAsynchronousRunNobodyWaits) {
  StallDetector detector(ring(true), moment(0));
  for (const IslandKey island : {kFirst, kSecond}) detector.reached(island, 1, moment(1));
  EXPECT_THAT(detector.stalled(moment(500), kPatience), ElementsAre(kFirst, kSecond, kThird));
}

TEST(StallDetector, WhoIsGivenAnIslandHasTimeAnew) {
  StallDetector detector(ring(), moment(0));
  detector.assigned(kSecond, 0, moment(450));
  EXPECT_THAT(detector.stalled(moment(500), kPatience), ElementsAre(kFirst, kThird));
}

TEST(StallDetector, AFinishedIslandIsNeverStalledAndKeepsNobodyWaiting) {
  StallDetector detector(ring(), moment(0));
  for (const IslandKey island : {kFirst, kSecond}) detector.reached(island, 1, moment(1));
  detector.finished(kThird);
  EXPECT_THAT(detector.stalled(moment(500), kPatience), ElementsAre(kFirst, kSecond));
}

TEST(StallDetector, WhereEpochsTakeLongPatienceIsLonger) {
  StallDetector detector(ring(), moment(0));
  detector.reached(kFirst, 1, moment(400));
  EXPECT_THAT(detector.stalled(moment(1500), kPatience), IsEmpty());
  EXPECT_THAT(detector.stalled(moment(1700), kPatience), ElementsAre(kSecond, kThird));
}

}  // namespace
}  // namespace demecal
