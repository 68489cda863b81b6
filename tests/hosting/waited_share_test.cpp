// The share of waiting, on made-up clocks and in a real run.
#include "hosting/hosted_island.hpp"

#include <gtest/gtest.h>

#include "scheduling/in_memory_run.hpp"

namespace demecal {
namespace {

using namespace std::chrono_literals;

TEST(WaitedShare, IsTheTimeThatWaitedOverTheTimeThatCounted) {
  WaitedShare share;
  const WaitedShare::Time begin{100s};
  EXPECT_EQ(share.at(begin), 0.0);
  share.set(begin, 0.0, 2.0);
  EXPECT_EQ(share.at(begin + 1s), 0.0);
  share.set(begin + 3s, 1.0, 2.0);
  EXPECT_DOUBLE_EQ(share.at(begin + 6s), 0.25);
  share.set(begin + 6s, 0.0, 0.0);
  EXPECT_DOUBLE_EQ(share.at(begin + 60s), 0.25);
  share.set(begin + 60s, 2.0, 2.0);
  EXPECT_DOUBLE_EQ(share.at(begin + 66s), 15.0 / 24.0);
  share.add_waited(3s);
  EXPECT_DOUBLE_EQ(share.at(begin + 66s), 18.0 / 24.0);
}

/// Keeps the last of what islands and workers tell.
class LastTold : public RunObserver {
 public:
  void on_progress(const Progress& progress) override { islands[progress.island] = progress; }
  void on_worker(const WorkerStatus& status) override { workers[status.worker] = status; }
  std::map<IslandKey, Progress> islands;
  std::map<std::string, WorkerStatus> workers;
};

TEST(WaitedShare, IslandsAndWorkersTellItAndMigrantsAreCounted) {
  const CalibrationData data = small_run(4);
  const auto exchange = make_exchange();
  // More slots than islands: some wait all the time.
  const WorkerThread worker(exchange, "worker", 12);
  const auto transport = join(exchange, Role::coordinator, "coordinator");
  LastTold told;
  const std::atomic<bool> interrupt{false};
  const RunResult result = EvolutionRun(*transport, data, told).run(interrupt, {});
  ASSERT_EQ(result.end, RunEnd::finished);
  EXPECT_GT(told.workers.at("worker").waited_share, 0.5);
  EXPECT_LE(told.workers.at("worker").waited_share, 1.0);
  ASSERT_EQ(told.islands.size(), 6u);
  for (const auto& [key, island] : told.islands) {
    EXPECT_EQ(island.migrants_sent, std::uint64_t{island.epoch} * data.archipelago.migrants);
    EXPECT_GE(island.waited_share, 0.0);
    EXPECT_LT(island.waited_share, 1.0);
    EXPECT_GT(island.figures.diversity, 0.0);
  }
}

}  // namespace
}  // namespace demecal
