// Which islands ought to get on and do not.
#include "coordinator/diligence.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace demecal {
namespace {

using std::chrono::milliseconds;
using ::testing::ElementsAre;
using ::testing::IsEmpty;

constexpr milliseconds kPatience{100};
constexpr IslandKey kFirst{0, 0}, kSecond{0, 1}, kThird{0, 2};

Diligence::Time at(int time_ms) {
  return Diligence::Time{} + milliseconds(time_ms);
}

/// Three islands in a ring: each takes in what the one before it sends.
Archipelago ring(bool asynchronous = false) {
  Archipelago archipelago;
  archipelago.joints = {0};
  archipelago.demes_per_joint = 3;
  archipelago.asynchronous = asynchronous;
  return archipelago;
}

TEST(Diligence, IslandsThatNeverBeganAreStalled) {
  const Diligence diligence(ring(), at(0));
  EXPECT_THAT(diligence.stalled(at(99), kPatience), IsEmpty());
  EXPECT_THAT(diligence.stalled(at(101), kPatience), ElementsAre(kFirst, kSecond, kThird));
}

TEST(Diligence, AnIslandThatWaitsForItsSourceIsNot) {
  Diligence diligence(ring(), at(0));
  for (const IslandKey island : {kFirst, kSecond}) diligence.reached(island, 1, at(1));
  // The first waits for the third, and the second has all it needs.
  EXPECT_THAT(diligence.stalled(at(500), kPatience), ElementsAre(kSecond, kThird));
}

TEST(Diligence, InAnAsynchronousRunNobodyWaits) {
  Diligence diligence(ring(true), at(0));
  for (const IslandKey island : {kFirst, kSecond}) diligence.reached(island, 1, at(1));
  EXPECT_THAT(diligence.stalled(at(500), kPatience), ElementsAre(kFirst, kSecond, kThird));
}

TEST(Diligence, WhoIsGivenAnIslandHasTimeAnew) {
  Diligence diligence(ring(), at(0));
  diligence.given(kSecond, 0, at(450));
  EXPECT_THAT(diligence.stalled(at(500), kPatience), ElementsAre(kFirst, kThird));
}

TEST(Diligence, AFinishedIslandIsNeverStalledAndKeepsNobodyWaiting) {
  Diligence diligence(ring(), at(0));
  for (const IslandKey island : {kFirst, kSecond}) diligence.reached(island, 1, at(1));
  diligence.finished(kThird);
  EXPECT_THAT(diligence.stalled(at(500), kPatience), ElementsAre(kFirst, kSecond));
}

TEST(Diligence, WhereEpochsTakeLongPatienceIsLonger) {
  Diligence diligence(ring(), at(0));
  diligence.reached(kFirst, 1, at(400));
  EXPECT_THAT(diligence.stalled(at(1500), kPatience), IsEmpty());
  EXPECT_THAT(diligence.stalled(at(1700), kPatience), ElementsAre(kSecond, kThird));
}

}  // namespace
}  // namespace demecal
