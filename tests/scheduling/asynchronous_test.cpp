// Islands of an asynchronous run take what migrants have come, and wait for none.
#include <gtest/gtest.h>

#include "../config/temporary_folder.hpp"
#include "disturbed_run.hpp"
#include "hosting/migrants.hpp"
#include "in_memory_run.hpp"
#include "mortal_transport.hpp"

namespace demecal {
namespace {

CalibrationData asynchronous_run() {
  CalibrationData data = small_run(12, Topology::full);
  data.archipelago.asynchronous = true;
  data.parameters.number_generations = 1500;
  data.archipelago.migration_interval = 1;
  return data;
}

/// One worker stops, unnoticed, when it has told of its first epoch, and goes on when all islands but its own are
/// finished. Where that does not come about the run is given up after a while.
class OneStops : public RunObserver {
 public:
  OneStops(std::string name, MortalTransport& network, std::size_t islands)
      : name_(std::move(name)), network_(network), left_(islands), held_(islands / 2) {}
  void on_progress(const Progress& progress) override {
    if (progress.worker == name_ && !stopped_) {
      stopped_ = true;
      network_.stop();
    }
  }
  void on_outcome(const Outcome&) override {
    if (--left_ <= held_) network_.go_on();
  }
  void on_tick() override { give_up = give_up || ++ticks_ > kMostTicks; }

  std::atomic<bool> give_up{false};

 private:
  std::string name_;
  MortalTransport& network_;
  std::size_t left_, held_;
  bool stopped_ = false;
  static constexpr int kMostTicks = 600 * kPatience;  ///< longer than it takes on a busy machine
  int ticks_ = 0;
};

/// Two workers hold half of the islands each.
RunEnd run_with_one_that_stops(const CalibrationData& data) {
  const auto exchange = make_exchange();
  auto mortal = std::make_unique<MortalTransport>(join(exchange, Role::worker, "stops"));
  MortalTransport& network = *mortal;
  WorkerThread stops(std::move(mortal), "stops", 1);
  WorkerThread goes_on(exchange, "goes on");
  const auto transport = join(exchange, Role::coordinator, "coordinator");
  OneStops observer("stops", network, islands(data.archipelago).size());
  const RunEnd end = EvolutionRun(*transport, data, observer).run(observer.give_up, {}).end;
  network.go_on();
  return end;
}

TEST(AsynchronousRun, GoesOnWithoutAWorkerThatHangs) {
  EXPECT_EQ(run_with_one_that_stops(asynchronous_run()), RunEnd::finished);
}

TEST(AsynchronousRun, TakesMigrantsIn) {
  const RunResult result = run_in_memory(asynchronous_run(), 2);
  EXPECT_EQ(result.end, RunEnd::finished);
  EXPECT_GT(result.migrations, 0U);
}

TEST(MigrantStore, GivesTheNewestOfEachSourceOnce) {
  const auto individual = [](double value) { return Individual{constant_tree(value), value}; };
  MigrantStore store;
  std::map<IslandKey, std::uint32_t> taken;
  const std::vector<IslandKey> sources{{0, 1}, {0, 2}};
  EXPECT_TRUE(store.collect_new(sources, taken).empty());
  store.put({1, {0, 1}, 1, {individual(1)}});
  store.put({1, {0, 1}, 3, {individual(3)}});
  store.put({1, {0, 2}, 2, {individual(2)}});
  EXPECT_EQ(store.collect_new(sources, taken), (Population{individual(3), individual(2)}));
  EXPECT_TRUE(store.collect_new(sources, taken).empty());
  store.put({1, {0, 1}, 2, {individual(7)}});
  EXPECT_TRUE(store.collect_new(sources, taken).empty());
  store.put({1, {0, 2}, 4, {individual(4)}});
  EXPECT_EQ(store.collect_new(sources, taken), Population{individual(4)});
}

TEST(AsynchronousRun, EndsWhateverBefallsIt) {
  for (std::uint64_t schedule = 0; schedule < 30; ++schedule) {
    CalibrationData data = small_run(20 + schedule % 3, schedule % 2 == 0 ? Topology::full : Topology::ring);
    data.archipelago.asynchronous = true;
    data.archipelago.migration_interval = 1;
    const TemporaryFolder folder;
    DisturbedRun disturbed(data, folder.path().string(), schedule);
    const RunResult result = disturbed.run();
    ASSERT_EQ(result.end, RunEnd::finished) << "schedule " << schedule << ":\n" << disturbed.happened().told;
    for (const auto& [island, front] : result.fronts) EXPECT_FALSE(front.empty()) << "schedule " << schedule;
  }
}

}  // namespace
}  // namespace demecal
