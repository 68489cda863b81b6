// What a watcher keeps of what it hears: the present state, whatever the order, and no more than is believable.
#include "monitor/watched.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "made_up_run.hpp"

namespace demecal {
namespace {

Progress after(std::uint32_t epoch, const std::string& worker = "one", IslandKey island = {0, 0}) {
  Progress progress;
  progress.run = kRun;
  progress.island = island;
  progress.worker = worker;
  progress.epoch = epoch;
  progress.generation = 10 * (epoch - 1);
  return progress;
}

WorkerStatus status(const std::string& worker, bool leaving = false) {
  WorkerStatus result;
  result.worker = worker;
  result.leaving = leaving;
  return result;
}

TEST(Watched, HasSeenNothingBeforeAnythingIsSaid) {
  const Watched watched;
  EXPECT_FALSE(watched.has_seen_anything());
  EXPECT_EQ(watched.calibration(), nullptr);
  EXPECT_EQ(watched.run(), nullptr);
  EXPECT_TRUE(watched.workers().empty());
}

TEST(Watched, ComesToTheSameFiguresInWhateverOrderTopicsArrive) {
  std::vector<Message> messages = made_up_messages(made_up_data());
  messages.insert(messages.end(), {made_up_cause(1, 2), made_up_cause(2, 3)});
  const Watched in_order = watched_after(messages);
  const auto& expected = in_order.run()->islands;
  ASSERT_EQ(expected.size(), 12u);
  RandomStream random{5};
  for (int round = 0; round < 50; ++round) {
    std::vector<Message> shuffled = messages;
    for (std::size_t i = shuffled.size(); i > 1; --i) std::swap(shuffled[i - 1], shuffled[random.index(i)]);
    const Watched watched = watched_after(shuffled);
    EXPECT_EQ(watched.run()->islands, expected);
    EXPECT_EQ(watched.calibration()->rounds, in_order.calibration()->rounds);
    EXPECT_EQ(watched.calibration()->causes, in_order.calibration()->causes);
    EXPECT_EQ(watched.calibration()->stage, in_order.calibration()->stage);
  }
}

TEST(Watched, CountsWhatAllEvolutionsOfACalibrationCost) {
  Watched watched;
  constexpr RunId kRuns = 20;  // more than are kept
  for (RunId run = 1; run <= kRuns; ++run) {
    LoopNews stage = made_up_stage(LoopNews::Stage::evolving, "evolving");
    stage.run = run;
    CalibrationData data = made_up_data();
    data.run = run;
    data.breeds = run == 2 ? Breeds::sets : Breeds::formulas;
    watched.take(stage, 0.0);
    watched.take(data, 0.0);
    Progress progress = after(2);
    progress.run = run;
    for (const std::uint64_t evaluations : {50U, 100U}) {
      progress.evaluations = evaluations;
      progress.migrants_taken = 3;
      ++progress.epoch;
      watched.take(progress, 0.0);
    }
  }
  EXPECT_EQ(watched.effort().evaluations, 100 * (kRuns - 1));
  EXPECT_EQ(watched.effort().sets, 100U);
  EXPECT_EQ(watched.effort().migrants, 3 * kRuns);
}

TEST(Watched, KeepsTheFiguresOfTheLatestEpoch) {
  const Watched watched = watched_after({made_up_data(), after(3, "one"), after(2, "two"), after(3, "two")});
  EXPECT_EQ(watched.run()->islands.at({0, 0}).epoch, 3u);
  EXPECT_EQ(watched.run()->islands.at({0, 0}).worker, "two");
}

TEST(Watched, IgnoresIslandsThatTheRunDoesNotHave) {
  CalibrationData data = made_up_data(2, 2);
  const std::vector<IslandKey> strange{{2, 0}, {0, 2}, {4'000'000'000, 0}, {0, 4'000'000'000}};
  for (const IslandKey island : strange) {
    EXPECT_TRUE(watched_after({data, after(1, "one", island)}).run()->islands.empty());
    EXPECT_TRUE(watched_after({after(1, "one", {1, 1}), after(1, "one", island), data}).run()->islands.size() == 1);
  }
  data.archipelago.demes_per_joint = 4'000'000'000;
  EXPECT_FALSE(watched_after({data}).has_seen_anything());
}

TEST(Watched, KeepsNoMoreThanAFewRunsAndCalibrations) {
  Watched watched;
  for (std::uint32_t i = 1; i <= 100; ++i) {
    Progress progress = after(1);
    progress.run = i;
    watched.take(progress, i);
    LoopNews news = made_up_stage(LoopNews::Stage::closing, "");
    news.calibration = i;
    news.run = i;
    watched.take(news, i);
  }
  EXPECT_EQ(watched.calibration()->stage.calibration, 100u);
  EXPECT_EQ(watched.run()->islands.begin()->second.run, 100u);
  EXPECT_LT(watched.other_calibrations(), 10u);
  for (std::uint32_t number = 0; number < 5000; ++number) {
    CauseFound cause = made_up_cause(number, 2);
    cause.calibration = 100;
    watched.take(cause, 101.0);
  }
  EXPECT_LE(watched.calibration()->causes.size(), 1000u);
  EXPECT_FALSE(watched.calibration()->causes.contains(0));
  for (int i = 0; i < 100; ++i) watched.take(WorkerLost{"nobody"}, 101.0);
  EXPECT_TRUE(watched.notices().empty());
}

TEST(Watched, TellsWorkersThatLeaveFromThoseThatAreLost) {
  using Presence = WatchedWorker::Presence;
  Watched watched =
      watched_after({made_up_data(), status("one"), status("two"), after(1, "one"), after(1, "two", {1, 0})});
  watched.take(status("one", true), 2.0);
  watched.take(WorkerLost{"one"}, 3.0);
  watched.take(WorkerLost{"two"}, 3.0);
  EXPECT_EQ(watched.worker("one")->presence, Presence::left);
  EXPECT_EQ(watched.worker("two")->presence, Presence::lost);
  EXPECT_EQ(watched.notices().back().text, "worker two is lost");
  watched.take(status("two"), 4.0);
  EXPECT_EQ(watched.worker("two")->presence, Presence::here);
  EXPECT_EQ(watched.notices().back().text, "worker two is back");
}

TEST(Watched, ShowsWorkersThatAreHereOrHaveToDoWithTheRun) {
  Watched watched = watched_after({made_up_data(), status("one"), status("two"), status("three"), after(1, "two")});
  for (const char* const name : {"two", "three"}) watched.take(status(name, true), 2.0);
  std::vector<std::string> names;
  for (const WatchedWorker* worker : watched.workers()) names.push_back(worker->status.worker);
  EXPECT_EQ(names, (std::vector<std::string>{"one", "two"}));
}

TEST(Watched, ACalibrationWhoseCoordinatorGoesIsLostUnlessItWasOver) {
  const auto after_stage = [](LoopNews::Stage stage) {
    return watched_after({made_up_stage(stage, ""), CalibrationLost{kCalibration}});
  };
  EXPECT_TRUE(after_stage(LoopNews::Stage::evolving).calibration()->lost);
  EXPECT_FALSE(after_stage(LoopNews::Stage::finished).calibration()->lost);
  EXPECT_FALSE(after_stage(LoopNews::Stage::interrupted).calibration()->lost);
  Watched resumed = after_stage(LoopNews::Stage::evolving);
  resumed.take(made_up_stage(LoopNews::Stage::evolving, ""), 2.0);
  EXPECT_FALSE(resumed.calibration()->lost);
}

TEST(Watched, ShowsTheCalibrationThatGoesOnAndCountsTheOthers) {
  LoopNews over = made_up_stage(LoopNews::Stage::finished, ""), second = made_up_stage(LoopNews::Stage::closing, "");
  over.calibration = kCalibration + 1;
  second.calibration = kCalibration + 2;
  Watched watched = watched_after({made_up_stage(LoopNews::Stage::evolving, ""), over});
  EXPECT_EQ(watched.calibration()->stage.calibration, kCalibration);
  EXPECT_EQ(watched.other_calibrations(), 0u);
  watched.take(second, 2.0);
  EXPECT_EQ(watched.calibration()->stage.calibration, second.calibration);
  EXPECT_EQ(watched.other_calibrations(), 1u);
}

TEST(Watched, LeavesAloneWhatDoesNotConcernPeople) {
  const Watched watched = watched_after({IslandTask{}, Migrants{}, Checkpoint{}, Outcome{}, Control{}});
  EXPECT_FALSE(watched.has_seen_anything());
}

}  // namespace
}  // namespace demecal
