// Speed and time left, against runs whose course is known.
#include "monitor/watched.hpp"

#include <gtest/gtest.h>

#include "made_up_run.hpp"

namespace demecal {
namespace {

constexpr double kSpeed = 28000.0;
constexpr double kPerGeneration = 280.0;

Progress steady(IslandKey island, std::uint32_t generation, int worker) {
  Progress progress;
  progress.run = kRun;
  progress.island = island;
  progress.worker = made_up_worker(worker).worker;
  progress.epoch = 1 + generation / 10;
  progress.generation = generation;
  progress.evaluations = 300 + static_cast<std::uint64_t>(kPerGeneration) * generation;
  progress.evaluations_per_s = kSpeed;
  return progress;
}

/// Islands of two joints and two demes, all at one generation, held by `workers` in turn.
Watched steady_run(std::uint32_t generation, int workers, std::uint32_t slots) {
  const CalibrationData data = made_up_data(2, 2);
  std::vector<Message> messages{data};
  int next = 0;
  for (int worker = 1; worker <= workers; ++worker) {
    WorkerStatus status = made_up_worker(worker, slots);
    status.waited_share = 0.0;
    messages.emplace_back(status);
  }
  for (const IslandKey island : islands(data.archipelago)) {
    messages.emplace_back(steady(island, generation, 1 + next++ % workers));
  }
  return watched_after(messages);
}

TEST(Pace, CountsEachWorkersSlotsAndNotItsIslands) {
  const auto speed = [](const Watched& watched) { return evaluations_per_s(watched, *watched.run(), 2.0); };
  EXPECT_NEAR(speed(steady_run(50, 1, 1)), kSpeed, 1e-6);
  EXPECT_NEAR(speed(steady_run(50, 1, 3)), 3 * kSpeed, 1e-6);
  EXPECT_NEAR(speed(steady_run(50, 2, 1)), 2 * kSpeed, 1e-6);
  EXPECT_NEAR(speed(steady_run(50, 1, 100)), 4 * kSpeed, 1e-6);
  EXPECT_EQ(speed(steady_run(200, 1, 1)), 0.0);
}

TEST(Pace, AWorkerThatIsGoneDoesNoWork) {
  Watched watched = steady_run(50, 2, 1);
  watched.take(WorkerLost{made_up_worker(2).worker}, 2.0);
  EXPECT_NEAR(evaluations_per_s(watched, *watched.run(), 2.0), kSpeed, 1e-6);
}

TEST(Pace, TimeLeftIsWhatTheGenerationsLeftTakeAtThatSpeed) {
  for (const std::uint32_t generation : {10u, 50u, 190u}) {
    const Watched watched = steady_run(generation, 2, 1);
    const double expected_s = 4 * (200.0 - generation) * kPerGeneration / (2 * kSpeed);
    ASSERT_TRUE(time_left_s(watched, *watched.run(), 2.0).has_value());
    EXPECT_NEAR(*time_left_s(watched, *watched.run(), 2.0), expected_s, 1e-9 * expected_s);
    EXPECT_NEAR(share_done(*watched.run()), generation / 200.0, 1e-12);
  }
}

TEST(Pace, OfIslandsNotHeardOfAllGenerationsAreLeft) {
  const Watched watched = watched_after({made_up_data(2, 2), steady({0, 0}, 100, 1)});
  EXPECT_NEAR(share_done(*watched.run()), 0.125, 1e-12);
  EXPECT_NEAR(*time_left_s(watched, *watched.run(), 2.0), 700 * kPerGeneration / kSpeed, 1e-9);
}

TEST(Pace, IsWhatWasSeenAsSoonAsThatCanBeTold) {
  constexpr double kSeen = 5600.0;
  Watched watched = watched_after({made_up_data(1, 1), made_up_worker(1)}, 0.0);
  for (int tenth = 0; tenth <= 200; ++tenth) {
    const double now_s = 0.1 * tenth;
    Progress progress = steady({0, 0}, static_cast<std::uint32_t>(tenth / 2), 1);
    progress.epoch = static_cast<std::uint32_t>(tenth + 1);
    progress.evaluations = 1'000'000 + static_cast<std::uint64_t>(kSeen * now_s);  // joined late: a million at once
    watched.take(progress, now_s);
    if (tenth > 16) {
      EXPECT_NEAR(evaluations_per_s(watched, *watched.run(), now_s), kSeen, 20.0) << now_s;
    }
  }
  EXPECT_NEAR(evaluations_per_s(watched, *watched.run(), 30.0), kSeen / 2, 0.1 * kSeen) << "nothing came for as long";
}

TEST(Pace, IsUnknownBeforeAnythingIsKnownAndOverWhenAllIsBred) {
  const Watched begun = watched_after({made_up_data(2, 2)});
  EXPECT_EQ(time_left_s(begun, *begun.run(), 2.0), std::nullopt);
  EXPECT_EQ(share_done(*begun.run()), 0.0);
  const Watched without_data = watched_after({steady({0, 0}, 10, 1)});
  EXPECT_EQ(time_left_s(without_data, *without_data.run(), 2.0), std::nullopt);
  const Watched over = steady_run(200, 1, 1);
  EXPECT_EQ(time_left_s(over, *over.run(), 2.0), 0.0);
}

}  // namespace
}  // namespace demecal
