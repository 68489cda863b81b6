// A run is its publisher's.
#include "transport/run_owners.hpp"

#include <gtest/gtest.h>

#include "random_messages.hpp"

namespace demecal {
namespace {

constexpr ParticipantId kOwner{1}, kStranger{2};
constexpr RunOwners::Time kNow{};

class Owners : public ::testing::Test {
 protected:
  using Messages = std::vector<Message>;

  CalibrationData data(RunId run, std::uint64_t seed = 1) {
    CalibrationData made = random.data();
    made.run = run;
    made.seed = seed;
    return made;
  }
  IslandTask task(RunId run, std::uint32_t attempt = 1) {
    IslandTask made;
    made.run = run;
    made.attempt = attempt;
    return made;
  }
  static Control end(RunId run) { return {run, Control::State::cancelled, ""}; }
  Messages arrived() {
    Messages all;
    while (auto message = mailbox.take(std::chrono::milliseconds{0})) all.push_back(*message);
    return all;
  }

  RandomMessages random{11};
  Mailbox mailbox;
  DroppedSamples dropped;
  RunOwners owners{mailbox, dropped, true};
};

TEST_F(Owners, TasksAndControlWaitForTheDataOfTheirSource) {
  owners.heard(kOwner, "owner", task(5), kNow);
  owners.heard(kStranger, "stranger", task(5, 9), kNow);
  EXPECT_TRUE(arrived().empty());
  const CalibrationData of_run = data(5);
  owners.heard(kOwner, "owner", of_run, kNow);
  EXPECT_EQ(arrived(), (Messages{of_run, task(5)}));
  EXPECT_EQ(dropped.count(), 1U);
}

TEST_F(Owners, WhatOthersSayOfARunIsDroppedAndCounted) {
  owners.heard(kOwner, "owner", data(5), kNow);
  arrived();
  owners.heard(kStranger, "stranger", data(5, 2), kNow);
  owners.heard(kStranger, "stranger", task(5, 9), kNow);
  owners.heard(kStranger, "stranger", Control{5, Control::State::running, ""}, kNow);
  owners.heard(kStranger, "stranger", end(5), kNow);
  owners.release(kNow + 10 * RunOwners::kBelated);
  EXPECT_TRUE(arrived().empty());
  EXPECT_EQ(dropped.count(), 3U);  // the end is kept, should the owner go
  owners.heard(kStranger, "stranger", end(5), kNow);
  EXPECT_EQ(dropped.count(), 4U);
}

TEST_F(Owners, AnEndFromElsewhereCountsWhenTheOwnerIsGone) {
  for (const bool before : {true, false}) {
    const RunId run = before ? 5 : 6;
    owners.heard(kOwner, "owner", data(run), kNow);
    arrived();
    if (before) owners.heard(kStranger, "stranger", end(run), kNow);
    owners.departed(kOwner, kNow);
    if (!before) owners.heard(kStranger, "stranger", end(run), kNow);
    EXPECT_EQ(arrived(), Messages{end(run)});
  }
}

TEST_F(Owners, ARunWhoseNumberShowsItsPublisherIsNobodyElses) {
  const RunId run = run_of(kOwner, 7);
  owners.heard(kStranger, "stranger", data(run, 2), kNow);
  owners.heard(kStranger, "stranger", task(run, 9), kNow);
  owners.heard(kStranger, "stranger", end(run), kNow);
  owners.release(kNow + 10 * RunOwners::kBelated);
  EXPECT_TRUE(arrived().empty());
  EXPECT_EQ(dropped.count(), 3U);
  const CalibrationData of_run = data(run);
  owners.heard(kOwner, "owner", of_run, kNow);
  EXPECT_EQ(arrived(), Messages{of_run});
  owners.heard(kStranger, "a coordinator that resumes", end(run), kNow);
  owners.departed(kOwner, kNow);
  EXPECT_EQ(arrived(), Messages{end(run)});
}

TEST_F(Owners, AnOwnerThatComesBackIsTheOwnerAgain) {
  const CalibrationData of_run = data(5);
  owners.heard(kOwner, "owner", of_run, kNow);
  owners.departed(kOwner, kNow);
  owners.heard(kOwner, "owner", of_run, kNow);
  arrived();
  owners.heard(kStranger, "stranger", end(5), kNow);
  EXPECT_TRUE(arrived().empty());
}

TEST_F(Owners, ARunWhoseOwnerStaysAwayIsOverAfterAWhile) {
  owners.heard(kOwner, "owner", data(5), kNow);
  owners.heard(kOwner, "owner", data(6), kNow);
  owners.heard(kOwner, "owner", end(6), kNow);
  arrived();
  owners.departed(kOwner, kNow);
  owners.release(kNow + kLongestAbsence / 2);
  EXPECT_TRUE(arrived().empty());
  owners.release(kNow + kLongestAbsence);
  EXPECT_EQ(arrived(), (Messages{Control{5, Control::State::cancelled, ""}}));
  owners.release(kNow + 2 * kLongestAbsence);
  EXPECT_TRUE(arrived().empty());
}

TEST_F(Owners, AnOwnerThatIsSeenAgainKeepsItsRunsThoughItSaysNothing) {
  owners.heard(kOwner, "owner", data(5), kNow);
  arrived();
  owners.departed(kOwner, kNow);
  owners.arrived(kOwner);
  owners.release(kNow + 2 * kLongestAbsence);
  owners.heard(kStranger, "stranger", end(5), kNow);
  EXPECT_TRUE(arrived().empty());
}

TEST_F(Owners, AnEndWithoutDataIsBelievedAfterAWhile) {
  owners.heard(kOwner, "owner", end(5), kNow);
  owners.departed(kOwner, kNow);
  owners.release(kNow + RunOwners::kBelated / 2);
  EXPECT_TRUE(arrived().empty());
  owners.release(kNow + RunOwners::kBelated);
  EXPECT_EQ(arrived(), Messages{end(5)});
}

TEST_F(Owners, AStrangersEarlyEndIsNotBelievedWhenTheDataCome) {
  owners.heard(kStranger, "stranger", end(5), kNow);
  owners.heard(kOwner, "owner", data(5), kNow);
  owners.release(kNow + 10 * RunOwners::kBelated);
  EXPECT_EQ(arrived().size(), 1U);
}

TEST_F(Owners, OneWhoInventsRunsIsHeardOfFewAndKeepsNobodyFromHisOwn) {
  for (RunId run = 100; run < 400; ++run) owners.heard(kStranger, "stranger", data(run), kNow);
  const std::size_t believed = arrived().size();
  EXPECT_LT(believed, 100U);
  EXPECT_EQ(dropped.count(), 300 - believed);
  owners.heard(kOwner, "owner", data(5), kNow);
  EXPECT_EQ(arrived().size(), 1U);
}

TEST_F(Owners, RunsThatAreOverMakeRoomForOthers) {
  for (RunId run = 1; run <= 300; ++run) {
    owners.heard(kOwner, "owner", data(run), kNow);
    owners.heard(kOwner, "owner", end(run), kNow);
  }
  EXPECT_EQ(arrived().size(), 600U);
  EXPECT_EQ(dropped.count(), 0U);
}

TEST_F(Owners, WhoOnlyWatchesHearsAtOnceWhatHasNoData) {
  RunOwners of_watcher(mailbox, dropped, false);
  of_watcher.heard(kOwner, "owner", end(5), kNow);
  EXPECT_EQ(arrived(), Messages{end(5)});
}

}  // namespace
}  // namespace demecal
