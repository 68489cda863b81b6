// Names and runs stand for participants, and workers come and go as their writers do.
#include "transport/participants.hpp"

#include <gtest/gtest.h>

#include <set>
#include <string>
#include <utility>
#include <vector>

#include "transport/mailbox.hpp"

namespace demecal {
namespace {

TEST(ParticipantOf, DiffersForNamesThatDifferLittle) {
  std::set<ParticipantId> seen;
  for (int process = 0; process < 300; ++process)
    for (const std::string host : {"a", "b", "host-1"})
      seen.insert(participant_of(host + "-" + std::to_string(process)));
  EXPECT_EQ(seen.size(), 900U);
}

TEST(RunOf, ShowsItsPublisherAndNoOther) {
  const ParticipantId one = participant_of("one"), two = participant_of("two");
  for (const std::uint16_t serial : {0, 1, 65535}) {
    const std::uint64_t run = run_of(one, serial);
    EXPECT_TRUE(shows_publisher(run));
    EXPECT_TRUE(may_publish(one, run));
    EXPECT_FALSE(may_publish(two, run));
  }
  EXPECT_NE(run_of(one, 1), run_of(one, 2));
  EXPECT_TRUE(may_publish(two, 5));
  EXPECT_FALSE(shows_publisher(5));
}

TEST(RunOf, TellsWhetherRunsHaveOnePublisher) {
  const ParticipantId one = participant_of("one"), two = participant_of("two");
  for (const std::uint16_t serial : {0, 1, 65535}) {
    EXPECT_TRUE(have_one_publisher(run_of(one, serial), run_of(one, 7)));
    EXPECT_FALSE(have_one_publisher(run_of(one, serial), run_of(two, serial)));
  }
  EXPECT_TRUE(have_one_publisher(5, 5));
  EXPECT_FALSE(have_one_publisher(5, 6));
  EXPECT_FALSE(have_one_publisher(run_of(one, 7), 7));
}

TEST(ParticipantOf, IsTheSameOnEveryHost) {
  EXPECT_EQ(to_string(participant_of("worker")), to_string(participant_of(std::string("wor") + "ker")));
  EXPECT_EQ(to_string(participant_of("worker")).substr(0, 6), "01.0f.");
  EXPECT_EQ(to_string(participant_of("worker")).size(), 35U);
}

constexpr WriterId kOne{1};
constexpr WriterId kTwo{2};

WorkerStatus status(const std::string& worker, bool leaving = false) {
  WorkerStatus result;
  result.worker = worker;
  result.leaving = leaving;
  return result;
}

class Presences : public ::testing::Test {
 protected:
  /// All that has been put until now.
  std::vector<Message> arrived() {
    std::vector<Message> all;
    while (auto message = mailbox.take(std::chrono::milliseconds{0})) all.push_back(*message);
    return all;
  }
  using Messages = std::vector<Message>;

  Mailbox mailbox;
  Presence presence{mailbox};
};

TEST_F(Presences, SilenceLosesTheWorkerOnce) {
  presence.receive(kOne, status("one"));
  presence.receive(kTwo, status("two"));
  presence.lost_liveliness(kOne);
  presence.lost_liveliness(kOne);
  presence.departed(kOne);
  EXPECT_EQ(arrived(), (Messages{status("one"), status("two"), WorkerLost{"one"}}));
}

TEST_F(Presences, DepartureWithoutSilenceLosesTheWorkerToo) {
  presence.receive(kOne, status("one"));
  presence.departed(kOne);
  EXPECT_EQ(arrived(), (Messages{status("one"), WorkerLost{"one"}}));
}

TEST_F(Presences, AWorkerThatLeavesIsNotLost) {
  presence.receive(kOne, status("one"));
  presence.receive(kOne, status("one", true));
  presence.lost_liveliness(kOne);
  presence.departed(kOne);
  EXPECT_EQ(arrived(), (Messages{status("one"), status("one", true)}));
}

TEST_F(Presences, ALostWorkerThatIsAliveAgainIsAnnouncedAgain) {
  presence.receive(kOne, status("one"));
  presence.regained_liveliness(kOne);
  presence.lost_liveliness(kOne);
  presence.regained_liveliness(kOne);
  presence.lost_liveliness(kOne);
  EXPECT_EQ(arrived(), (Messages{status("one"), WorkerLost{"one"}, status("one"), WorkerLost{"one"}}));
}

TEST_F(Presences, ARepeatedStatusIsNewsOnlyOfALostWorker) {
  presence.receive(kOne, status("one"));
  presence.receive(kOne, status("one"));
  presence.lost_liveliness(kOne);
  presence.receive(kOne, status("one"));
  presence.receive(kOne, status("one"));
  presence.lost_liveliness(kOne);
  EXPECT_EQ(arrived(), (Messages{status("one"), WorkerLost{"one"}, status("one"), WorkerLost{"one"}}));
}

TEST_F(Presences, NewsOfACalibrationComeFromOneWriterWhileItIsThere) {
  CalibrationPresence reporters(mailbox);
  LoopNews news;
  news.calibration = 3;
  EXPECT_TRUE(reporters.receive(kOne, news));
  EXPECT_FALSE(reporters.receive(kTwo, news));
  reporters.departed(kTwo);
  reporters.departed(kOne);
  EXPECT_EQ(arrived(), (Messages{news, CalibrationLost{3}}));
  EXPECT_TRUE(reporters.receive(kTwo, news));
  EXPECT_EQ(arrived(), Messages{news});
}

TEST_F(Presences, WhatWasFoundComesFromTheParticipantOfTheNews) {
  CalibrationPresence reporters(mailbox);
  LoopNews news;
  news.calibration = 3;
  CauseFound cause;
  cause.calibration = 3;
  cause.number = 1;
  FinalFigures figures;
  figures.calibration = 3;
  WriterId same_participant = kOne;
  same_participant.back() = 7;
  EXPECT_TRUE(reporters.receive(kTwo, figures)) << "nobody's calibration yet";
  EXPECT_TRUE(reporters.receive(kOne, news));
  EXPECT_FALSE(reporters.receive(kTwo, cause));
  EXPECT_FALSE(reporters.receive(kTwo, figures));
  EXPECT_TRUE(reporters.receive(same_participant, cause));
  EXPECT_TRUE(reporters.receive(same_participant, figures));
  reporters.departed(same_participant);  // its writer of news is there
  reporters.departed(kOne);
  Messages all = arrived();
  std::erase(all, Message(figures));
  EXPECT_EQ(all, (Messages{news, cause, CalibrationLost{3}}));
}

TEST_F(Presences, ACalibrationThatCameToItsEndIsNotLost) {
  using Stage = LoopNews::Stage;
  const std::vector<std::pair<Stage, bool>> stages{{Stage::preparing, false},  {Stage::evolving, false},
                                                   {Stage::closing, false},    {Stage::finished, true},
                                                   {Stage::interrupted, true}, {Stage::failed, true}};
  for (const auto& [stage, is_end] : stages) {
    CalibrationPresence reporters(mailbox);
    LoopNews news, round;
    news.calibration = round.calibration = 3;
    news.stage = stage;
    round.round = 1;  // says nothing of the stage
    reporters.receive(kOne, news);
    reporters.receive(kOne, round);
    reporters.departed(kOne);
    Messages expected{news, round};
    if (!is_end) expected.emplace_back(CalibrationLost{3});
    EXPECT_EQ(arrived(), expected) << static_cast<int>(stage);
  }
}

TEST_F(Presences, ACalibrationThatGoesOnAfterItsEndCanBeLost) {
  CalibrationPresence reporters(mailbox);
  LoopNews interrupted, resumed;
  interrupted.calibration = resumed.calibration = 3;
  interrupted.stage = LoopNews::Stage::interrupted;
  reporters.receive(kOne, interrupted);
  reporters.receive(kOne, resumed);
  reporters.departed(kOne);
  EXPECT_EQ(arrived(), (Messages{interrupted, resumed, CalibrationLost{3}}));
}

TEST_F(Presences, WritersThatPublishedNothingAreNobody) {
  presence.lost_liveliness(kOne);
  presence.regained_liveliness(kOne);
  presence.departed(kOne);
  EXPECT_TRUE(arrived().empty());
}

}  // namespace
}  // namespace demecal
