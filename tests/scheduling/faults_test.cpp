// Whatever befalls a run, it finds the same formulas to the bit.
#include <gtest/gtest.h>

#include <map>

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

TEST(Faults, OfTwoHundredAndFortySchedulesChangeNothing) {
  constexpr std::uint64_t kSchedules = 240, kRuns = 6;
  std::map<std::uint64_t, RunResult> undisturbed;
  Disturbances all;
  for (std::uint64_t schedule = 0; schedule < kSchedules; ++schedule) {
    const CalibrationData data = longer_run(1 + schedule % kRuns);
    if (!undisturbed.contains(data.seed)) undisturbed[data.seed] = run_in_memory(data, 1);
    const TemporaryFolder folder;
    DisturbedRun disturbed(data, folder.path().string(), schedule);
    const RunResult result = disturbed.run();
    ASSERT_EQ(result.end, RunEnd::finished) << "schedule " << schedule << ":\n" << disturbed.happened().told;
    ASSERT_TRUE(same_fronts(undisturbed[data.seed], result)) << "schedule " << schedule;
    const Disturbances& happened = disturbed.happened();
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
  for (std::uint64_t schedule = 0; schedule < 12; ++schedule) {
    const TemporaryFolder folder;
    DisturbedRun disturbed(data, folder.path().string(), schedule);
    const RunResult result = disturbed.run();
    ASSERT_EQ(result.end, RunEnd::finished) << "schedule " << schedule << ":\n" << disturbed.happened().told;
    ASSERT_TRUE(same_fronts(undisturbed, result)) << "schedule " << schedule;
  }
}

}  // namespace
}  // namespace demecal
