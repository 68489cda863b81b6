// Whatever befalls a run, it finds the same formulas to the bit.
#include <gtest/gtest.h>

#include <atomic>
#include <functional>
#include <thread>
#include <vector>

#include "../config/temporary_folder.hpp"
#include "disturbed_run.hpp"

namespace demecal {
namespace {

CalibrationData longer_run(std::uint64_t seed) {
  constexpr Topology kTopologies[] = {Topology::ring, Topology::full, Topology::none};
  CalibrationData data = small_run(seed, kTopologies[seed % 3], seed % 2 == 0);
  data.parameters.number_generations = 32;
  data.archipelago.migration_interval = 2;
  return data;
}

/// What came of one schedule.
struct Disturbed {
  RunResult result;
  Disturbances happened;
};

/// All schedules, several at a time, since what is disturbed mostly waits until that is noticed.
std::vector<Disturbed> try_schedules(std::uint64_t count,
                                     const std::function<CalibrationData(std::uint64_t)>& data_of) {
  constexpr int kAtOnce = 8;
  std::vector<Disturbed> tried(count);
  std::atomic<std::uint64_t> next{0};
  std::vector<std::jthread> threads;
  for (int thread = 0; thread < kAtOnce; ++thread) {
    threads.emplace_back([&] {
      for (std::uint64_t schedule = next++; schedule < count; schedule = next++) {
        const TemporaryFolder folder;
        DisturbedRun disturbed(data_of(schedule), folder.path().string(), schedule);
        RunResult result = disturbed.run();
        tried[schedule] = {std::move(result), disturbed.happened()};
      }
    });
  }
  threads.clear();
  return tried;
}

TEST(Faults, OfTwoHundredAndFortySchedulesChangeNothing) {
  constexpr std::uint64_t kSchedules = 240, kRuns = 6;
  std::vector<RunResult> undisturbed;
  for (std::uint64_t run = 0; run < kRuns; ++run) undisturbed.push_back(run_in_memory(longer_run(1 + run), 1));
  const std::vector<Disturbed> tried =
      try_schedules(kSchedules, [](std::uint64_t schedule) { return longer_run(1 + schedule % kRuns); });
  Disturbances all;
  for (std::uint64_t schedule = 0; schedule < kSchedules; ++schedule) {
    const auto& [result, happened] = tried[schedule];
    ASSERT_EQ(result.end, RunEnd::finished) << "schedule " << schedule << ":\n" << happened.told;
    ASSERT_TRUE(same_fronts(undisturbed[schedule % kRuns], result)) << "schedule " << schedule;
    all.killed += happened.killed;
    all.stopped += happened.stopped;
    all.returned += happened.returned;
    all.left += happened.left;
    all.joined += happened.joined;
    all.resumed += happened.resumed;
  }
  // The schedules did befall the runs.
  for (const int count : {all.killed, all.stopped, all.returned, all.left, all.resumed}) EXPECT_GT(count, 100);
  RecordProperty("killed", all.killed);
  RecordProperty("stopped", all.stopped);
  RecordProperty("returned", all.returned);
  RecordProperty("resumed", all.resumed);
}

TEST(Faults, ChangeNothingWhereEpochsAreShorterThanMessagesTake) {
  CalibrationData data = small_run(9, Topology::full);
  data.parameters.number_generations = 300;
  data.archipelago.migration_interval = 1;
  const RunResult undisturbed = run_in_memory(data, 1);
  const std::vector<Disturbed> tried = try_schedules(12, [&](std::uint64_t) { return data; });
  for (std::size_t schedule = 0; schedule < tried.size(); ++schedule) {
    const auto& [result, happened] = tried[schedule];
    ASSERT_EQ(result.end, RunEnd::finished) << "schedule " << schedule << ":\n" << happened.told;
    ASSERT_TRUE(same_fronts(undisturbed, result)) << "schedule " << schedule;
  }
}

}  // namespace
}  // namespace demecal
