// What the benchmark of distribution computes from what it measures.
#include <gtest/gtest.h>
#include <unistd.h>

#include "distribution/cost_model.hpp"
#include "distribution/figures.hpp"
#include "distribution/load.hpp"
#include "distribution/processor_time.hpp"

namespace demecal::bench {
namespace {

TEST(CostModel, FindsTheLineThatTheTimesLieOn) {
  const CostModel model = fit({{8, 0.018}, {32, 0.042}, {128, 0.138}});
  EXPECT_NEAR(model.fixed_s, 0.010, 1e-12);
  EXPECT_NEAR(model.per_island_s, 0.001, 1e-12);
  EXPECT_NEAR(model.at(1000), 1.010, 1e-9);
}

TEST(CostModel, OfOneNumberOfIslandsIsConstant) {
  EXPECT_EQ(fit({{8, 0.5}, {8, 0.7}}).at(1000), 0.6);
}

TEST(ProcessorTime, OfThisProcessGrowsWithWhatItComputes) {
  const auto before = thread_seconds(::getpid());
  ASSERT_FALSE(before.empty());
  const double own = own_seconds();
  while (own_seconds() - own < 0.05) {
  }
  const Split split = used_between(before, thread_seconds(::getpid()));
  EXPECT_GT(split.total_s, 0.03);
  EXPECT_LE(split.busiest_thread_s, split.total_s);
}

TEST(ProcessorTime, OfNoProcessIsEmpty) {
  EXPECT_TRUE(thread_seconds(-1).empty());
}

TEST(Load, HasTheThesissSizeAndSoManySleepers) {
  const CalibrationData thesis = thesis_run(2, 1);
  EXPECT_EQ(islands(thesis.archipelago).size(), 12u);
  EXPECT_EQ(thesis.parameters.population_size, 300);
  EXPECT_EQ(thesis.tables.front().target.size(), 30u);
  for (const std::uint32_t count : {8u, 32u, 128u}) {
    EXPECT_EQ(islands(sleeping_run(count, 5, 1).archipelago).size(), count);
  }
}

TEST(SpeedUp, IsTheMedianOfPairs) {
  DistributionFigures slow, fast, faster;
  slow.wall_s = 2.0;
  fast.wall_s = 1.0;
  faster.wall_s = 0.5;
  const SpeedUp pairs = speed_up({slow, slow, slow}, {fast, faster, slow});
  EXPECT_EQ(pairs.median, 2.0);
  EXPECT_EQ(pairs.least, 1.0);
  EXPECT_EQ(pairs.greatest, 4.0);
}

TEST(SpeedUp, IsAllowedByTheBusierWorkerAndByAllThatTwoCoresHaveToDo) {
  DistributionFigures one, uneven, costly;
  one.worker_s = 2.0;
  uneven.worker_s = 2.0;
  uneven.busiest_worker_s = 1.25;
  costly = uneven;
  costly.coordinator_s = 1.0;
  one.wall_s = uneven.wall_s = costly.wall_s = 1.0;
  EXPECT_EQ(speed_up({one}, {uneven}).allowed, 1.6);
  EXPECT_NEAR(speed_up({one}, {costly}).allowed, 2.0 / 1.5, 1e-12);
}

TEST(SleepingIslands, AreAsEfficientAsTheirEpochsAreShort) {
  Sleeping run{0.5, {}};
  run.run.wall_s = 2.4;
  run.run.epochs = 5;
  run.run.reached_s = {0.1, 0.9, 1.4, 1.9, 2.4};
  EXPECT_NEAR(run.efficiency(), 0.5 / 0.6, 1e-12);
  EXPECT_NEAR(run.settled_epoch_s(), 0.5, 1e-12);
  Sleeping slower = run, slowest = run;
  slower.run.wall_s = 3.0;
  slowest.run.wall_s = 4.0;
  EXPECT_EQ(median_of({slowest, run, slower}).run.wall_s, 3.0);
}

}  // namespace
}  // namespace demecal::bench
