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
  RejectionLog rejections;
  RunOwners owners{mailbox, rejections, true};
};

TEST_F(Owners, TasksAndControlWaitForTheDataOfTheirSource) {
  owners.receive(kOwner, "owner", task(5), kNow);
  owners.receive(kStranger, "stranger", task(5, 9), kNow);
  EXPECT_TRUE(arrived().empty());
  const CalibrationData of_run = data(5);
  owners.receive(kOwner, "owner", of_run, kNow);
  EXPECT_EQ(arrived(), (Messages{of_run, task(5)}));
  EXPECT_EQ(rejections.count(), 1U);
}

TEST_F(Owners, WhatOthersPublishAboutARunIsRejectedAndCounted) {
  owners.receive(kOwner, "owner", data(5), kNow);
  arrived();
  owners.receive(kStranger, "stranger", data(5, 2), kNow);
  owners.receive(kStranger, "stranger", task(5, 9), kNow);
  owners.receive(kStranger, "stranger", Control{5, Control::State::running, ""}, kNow);
  owners.receive(kStranger, "stranger", end(5), kNow);
  owners.release(kNow + 10 * RunOwners::kLateGrace);
  EXPECT_TRUE(arrived().empty());
  EXPECT_EQ(rejections.count(), 3U);  // the end is kept, should the owner go
  owners.receive(kStranger, "stranger", end(5), kNow);
  EXPECT_EQ(rejections.count(), 4U);
}

TEST_F(Owners, AnEndFromElsewhereCountsWhenTheOwnerIsGone) {
  for (const bool before : {true, false}) {
    const RunId run = before ? 5 : 6;
    owners.receive(kOwner, "owner", data(run), kNow);
    arrived();
    if (before) owners.receive(kStranger, "stranger", end(run), kNow);
    owners.departed(kOwner, kNow);
    if (!before) owners.receive(kStranger, "stranger", end(run), kNow);
    EXPECT_EQ(arrived(), Messages{end(run)});
  }
}

TEST_F(Owners, ARunWhoseNumberShowsItsPublisherIsNobodyElses) {
  const RunId run = run_of(kOwner, 7);
  owners.receive(kStranger, "stranger", data(run, 2), kNow);
  owners.receive(kStranger, "stranger", task(run, 9), kNow);
  owners.receive(kStranger, "stranger", end(run), kNow);
  owners.release(kNow + 10 * RunOwners::kLateGrace);
  EXPECT_TRUE(arrived().empty());
  EXPECT_EQ(rejections.count(), 3U);
  const CalibrationData of_run = data(run);
  owners.receive(kOwner, "owner", of_run, kNow);
  EXPECT_EQ(arrived(), Messages{of_run});
  owners.receive(kStranger, "a coordinator that resumes", end(run), kNow);
  owners.departed(kOwner, kNow);
  EXPECT_EQ(arrived(), Messages{end(run)});
}

TEST_F(Owners, AnOwnerThatComesBackIsTheOwnerAgain) {
  const CalibrationData of_run = data(5);
  owners.receive(kOwner, "owner", of_run, kNow);
  owners.departed(kOwner, kNow);
  owners.receive(kOwner, "owner", of_run, kNow);
  arrived();
  owners.receive(kStranger, "stranger", end(5), kNow);
  EXPECT_TRUE(arrived().empty());
}

TEST_F(Owners, ARunWhoseOwnerStaysAwayIsOverAfterAWhile) {
  owners.receive(kOwner, "owner", data(5), kNow);
  owners.receive(kOwner, "owner", data(6), kNow);
  owners.receive(kOwner, "owner", end(6), kNow);
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
  owners.receive(kOwner, "owner", data(5), kNow);
  arrived();
  owners.departed(kOwner, kNow);
  owners.arrived(kOwner);
  owners.release(kNow + 2 * kLongestAbsence);
  owners.receive(kStranger, "stranger", end(5), kNow);
  EXPECT_TRUE(arrived().empty());
}

TEST_F(Owners, AnEndWithoutDataIsBelievedAfterAWhile) {
  owners.receive(kOwner, "owner", end(5), kNow);
  owners.departed(kOwner, kNow);
  owners.release(kNow + RunOwners::kLateGrace / 2);
  EXPECT_TRUE(arrived().empty());
  owners.release(kNow + RunOwners::kLateGrace);
  EXPECT_EQ(arrived(), Messages{end(5)});
}

TEST_F(Owners, AStrangersEarlyEndIsNotBelievedWhenTheDataCome) {
  owners.receive(kStranger, "stranger", end(5), kNow);
  owners.receive(kOwner, "owner", data(5), kNow);
  owners.release(kNow + 10 * RunOwners::kLateGrace);
  EXPECT_EQ(arrived().size(), 1U);
}

TEST_F(Owners, FewRunsOfOneWhoInventsThemAreBelievedAndNobodyElseLosesAny) {
  for (RunId run = 100; run < 400; ++run) owners.receive(kStranger, "stranger", data(run), kNow);
  const std::size_t believed = arrived().size();
  EXPECT_LT(believed, 100U);
  EXPECT_EQ(rejections.count(), 300 - believed);
  owners.receive(kOwner, "owner", data(5), kNow);
  EXPECT_EQ(arrived().size(), 1U);
}

TEST_F(Owners, RunsThatAreOverMakeRoomForOthers) {
  for (RunId run = 1; run <= 300; ++run) {
    owners.receive(kOwner, "owner", data(run), kNow);
    owners.receive(kOwner, "owner", end(run), kNow);
  }
  EXPECT_EQ(arrived().size(), 600U);
  EXPECT_EQ(rejections.count(), 0U);
}

TEST_F(Owners, WatchersReceiveAtOnceWhatHasNoData) {
  RunOwners of_watcher(mailbox, rejections, false);
  of_watcher.receive(kOwner, "owner", end(5), kNow);
  EXPECT_EQ(arrived(), Messages{end(5)});
}

}  // namespace
}  // namespace demecal
