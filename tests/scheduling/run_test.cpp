// A run gives the same formulas whoever computes them, whenever they come and go.
#include <gtest/gtest.h>

#include <algorithm>

#include "in_memory_run.hpp"

namespace demecal {
namespace {

TEST(EvolutionRun, EveryIslandReturnsAFrontAndBreedsAllGenerations) {
  const CalibrationData data = small_run(1);
  const RunResult result = run_in_memory(data, 1);
  EXPECT_EQ(result.end, RunEnd::finished);
  ASSERT_EQ(result.fronts.size(), 6U);
  for (const auto& [island, front] : result.fronts) EXPECT_FALSE(front.empty());
  EXPECT_EQ(result.generations, 6U * 12U);
  EXPECT_GT(result.migrations, 0U);
  EXPECT_GT(result.evaluations, 6U * 40U);
}

TEST(EvolutionRun, IsTheSameForAnyNumberOfWorkersWhereConstantsAreFitted) {
  CalibrationData data = small_run(2, Topology::ring, true);
  data.parameters.constant_share = 0.3;
  data.parameters.linear_scaling = true;
  RunResult before;
  for (const ConstantPolicy policy : {ConstantPolicy::none, ConstantPolicy::lamarckian, ConstantPolicy::baldwin}) {
    data.parameters.constants = policy;
    const RunResult alone = run_in_memory(data, 1);
    EXPECT_TRUE(same_fronts(alone, run_in_memory(data, 3, 2)));
    EXPECT_TRUE(same_fronts(alone, run_in_memory(data, 6)));
    EXPECT_FALSE(same_fronts(alone, before));
    before = alone;
  }
}

TEST(EvolutionRun, IsTheSameForAnyNumberOfWorkersAndSlots) {
  for (const Topology topology : {Topology::none, Topology::ring, Topology::full}) {
    const CalibrationData data = small_run(2, topology, topology == Topology::ring);
    const RunResult alone = run_in_memory(data, 1);
    EXPECT_TRUE(same_fronts(alone, run_in_memory(data, 2)));
    EXPECT_TRUE(same_fronts(alone, run_in_memory(data, 6)));
    EXPECT_TRUE(same_fronts(alone, run_in_memory(data, 2, 3)));
  }
}

TEST(EvolutionRun, OtherSeedsGiveOtherFormulas) {
  CalibrationData data = small_run(3);
  const RunResult one = run_in_memory(data, 2);
  data.seed = 4;
  EXPECT_FALSE(same_fronts(one, run_in_memory(data, 2)));
}

TEST(EvolutionRun, MigrationChangesWhatIslandsFind) {
  EXPECT_FALSE(
      same_fronts(run_in_memory(small_run(5, Topology::none), 2), run_in_memory(small_run(5, Topology::ring), 2)));
}

/// Does `action` once, after the first few epochs were heard of.
class AfterSomeEpochs : public RunObserver {
 public:
  explicit AfterSomeEpochs(int epochs, std::function<void()> action) : left_(epochs), action_(std::move(action)) {}
  void on_progress(const Progress&) override {
    if (--left_ == 0) action_();
  }

 private:
  int left_;
  std::function<void()> action_;
};

TEST(EvolutionRun, IsTheSameWhenAWorkerLeavesAndAnotherComes) {
  const CalibrationData data = small_run(6);
  const RunResult undisturbed = run_in_memory(data, 1);
  for (int epochs = 1; epochs <= 12; epochs += 3) {
    const auto exchange = make_exchange();
    auto first = std::make_unique<WorkerThread>(exchange, "first");
    std::unique_ptr<WorkerThread> second, third;
    AfterSomeEpochs disturb(epochs, [&] {
      second = std::make_unique<WorkerThread>(exchange, "second");
      first->stop();
      third = std::make_unique<WorkerThread>(exchange, "third");
    });
    const auto transport = join(exchange, Role::coordinator, "coordinator");
    const std::atomic<bool> interrupt{false};
    const RunResult result = EvolutionRun(*transport, data, disturb).run(interrupt, {});
    EXPECT_EQ(result.end, RunEnd::finished);
    EXPECT_TRUE(same_fronts(undisturbed, result)) << "after " << epochs << " epochs";
  }
}

TEST(EvolutionRun, WorkersThatComeLateAreGivenIslands) {
  const CalibrationData data = small_run(7);
  const auto exchange = make_exchange();
  const auto transport = join(exchange, Role::coordinator, "coordinator");
  std::unique_ptr<WorkerThread> late;
  class ComeOnTick : public RunObserver {
   public:
    explicit ComeOnTick(std::function<void()> come) : come_(std::move(come)) {}
    void on_tick() override {
      if (come_) std::exchange(come_, nullptr)();
    }

   private:
    std::function<void()> come_;
  } observer([&] { late = std::make_unique<WorkerThread>(exchange, "late"); });
  const std::atomic<bool> interrupt{false};
  const RunResult result = EvolutionRun(*transport, data, observer).run(interrupt, {});
  EXPECT_TRUE(same_fronts(run_in_memory(data, 1), result));
}

TEST(EvolutionRun, EndsWithoutWorkersAfterItsPatience) {
  const auto exchange = make_exchange();
  const auto transport = join(exchange, Role::coordinator, "coordinator");
  RunObserver silent;
  const std::atomic<bool> interrupt{false};
  const RunResult result =
      EvolutionRun(*transport, small_run(8), silent).run(interrupt, {.worker = std::chrono::milliseconds(200)});
  EXPECT_EQ(result.end, RunEnd::no_worker);
}

TEST(EvolutionRun, AnInterruptKeepsWhatWasReached) {
  CalibrationData data = small_run(9);
  data.parameters.number_generations = 100000;
  const auto exchange = make_exchange();
  WorkerThread worker(exchange, "worker");
  const auto transport = join(exchange, Role::coordinator, "coordinator");
  std::atomic<bool> interrupt{false};
  AfterSomeEpochs observer(20, [&] { interrupt = true; });
  const RunResult result = EvolutionRun(*transport, data, observer).run(interrupt, {});
  EXPECT_EQ(result.end, RunEnd::interrupted);
  EXPECT_TRUE(
      std::any_of(result.fronts.begin(), result.fronts.end(), [](const auto& front) { return !front.second.empty(); }));
  EXPECT_GE(result.history.size(), 20U);
}

TEST(EvolutionRun, EndsWhereLastCheckpointsCameButTheirWorkersDiedBeforeTheOutcomes) {
  const CalibrationData data = small_run(11);
  RunState known(data);
  class Checkpoints : public RunObserver {
   public:
    explicit Checkpoints(RunState& state) : state_(state) {}
    void on_checkpoint(const Checkpoint& checkpoint) override { state_.take(checkpoint); }

   private:
    RunState& state_;
  } observer(known);
  const auto exchange = make_exchange();
  WorkerThread worker(exchange, "worker", 1, kAllCheckpoints);
  const auto transport = join(exchange, Role::coordinator, "coordinator");
  const std::atomic<bool> interrupt{false};
  const RunResult first = EvolutionRun(*transport, data, observer).run(interrupt, {});
  known.rename(data.run + 1);
  RunObserver silent;
  const RunResult second = EvolutionRun(*transport, known, silent).run(interrupt, {});
  EXPECT_TRUE(same_fronts(first, second));
  EXPECT_EQ(first.evaluations, second.evaluations);
}

TEST(Worker, BeginsTheNewestOfTheTasksThatCameBeforeTheirData) {
  const CalibrationData data = small_run(12, Topology::none);
  const IslandKey island = islands(data.archipelago).front();
  const auto exchange = make_exchange();
  WorkerThread worker(exchange, "worker");
  const auto transport = join(exchange, Role::coordinator, "coordinator");
  const RunState fresh(data);
  transport->publish(fresh.task(island, 2, "worker"));
  transport->publish(fresh.task(island, 1, "another"));
  transport->publish(data);
  const auto deadline = std::chrono::steady_clock::now() + std::chrono::seconds(20);
  bool answered = false;
  while (!answered && std::chrono::steady_clock::now() < deadline) {
    const auto message = transport->receive(std::chrono::milliseconds(100));
    answered = message && std::holds_alternative<Outcome>(*message);
  }
  EXPECT_TRUE(answered);
}

/// Publishes what it is given when the first epochs were heard of; the run that it disturbs is compared with a calm
/// one.
RunResult disturbed_by(const CalibrationData& data, const std::string& name,
                       const std::function<void(Transport&)>& disturb) {
  const auto exchange = make_exchange();
  WorkerThread worker(exchange, "worker");
  const auto stranger = join(exchange, Role::worker, name);
  for (const std::uint32_t joint : data.archipelago.joints) stranger->offer_migrants(joint);
  const auto transport = join(exchange, Role::coordinator, "coordinator");
  AfterSomeEpochs watch(2, [&] { disturb(*stranger); });
  const std::atomic<bool> interrupt{false};
  return EvolutionRun(*transport, data, watch).run(interrupt, {});
}

TEST(EvolutionRun, MalformedMessagesOfOthersChangeNothing) {
  const CalibrationData data = small_run(10);
  const RunResult result = disturbed_by(data, "stranger", [&](Transport& stranger) {
    Outcome forged{.run = data.run, .attempt = 1, .island = {99, 0}, .worker = "stranger", .front = {}};
    stranger.publish(forged);
    Checkpoint broken{.run = data.run, .attempt = 1, .island = {0, 0}, .state = {}, .recent = {}};
    broken.state.epoch = 3;
    broken.state.population.push_back({Tree{{Primitive::add, 0, 0.0}}, 0.0});
    stranger.publish(broken);
    stranger.publish(Migrants{data.run, {0, 7}, 1, {}});
    stranger.publish(Migrants{data.run + 1, {0, 1}, 1, {}});
  });
  EXPECT_TRUE(same_fronts(run_in_memory(data, 1), result));
  EXPECT_EQ(result.rejected, 2U);
}

/// What an island of the run would come to, had it other data to learn from.
Checkpoint bred_elsewhere(const CalibrationData& data, IslandKey key) {
  CalibrationData other = data;
  for (double& target : other.tables[0].target) target = -target;
  Island island(other.parameters, other.archipelago, other.tables[0], key, 99);
  Checkpoint checkpoint;
  while (!island.finished()) {
    island.run_epoch({});
    checkpoint.recent.push_back({data.run, key, island.state().epoch, island.emigrants(), {}});
  }
  checkpoint.run = data.run;
  checkpoint.attempt = 1;
  checkpoint.island = key;
  checkpoint.state = island.state();
  checkpoint.worker = "stranger";
  return checkpoint;
}

TEST(EvolutionRun, SoundMessagesOfOneWhoWasGivenNothingChangeNothing) {
  for (const Topology topology : {Topology::ring, Topology::full}) {
    const CalibrationData data = small_run(13, topology);
    const RunResult result = disturbed_by(data, "stranger", [&](Transport& stranger) {
      for (const IslandKey key : islands(data.archipelago)) {
        if (key.joint != 0) continue;
        const Checkpoint forged = bred_elsewhere(data, key);
        for (Migrants migrants : forged.recent) {
          migrants.worker = "stranger";
          stranger.publish(migrants);
        }
        stranger.publish(forged);
        stranger.publish(Outcome{data.run, 1, key, "stranger", forged.state.generation, 1, 1, forged.state.front});
      }
    });
    EXPECT_EQ(result.end, RunEnd::finished);
    EXPECT_TRUE(same_fronts(run_in_memory(data, 1), result));
    EXPECT_EQ(result.rejected, 6U);
  }
}

TEST(EvolutionRun, AWorkerThatTakesIslandsAndDoesNothingIsSetAside) {
  const CalibrationData data = small_run(14);
  const auto exchange = make_exchange();
  const auto idler = join(exchange, Role::worker, "idler");
  idler->publish(WorkerStatus{.worker = "idler", .host = "here", .slots = 4000, .version = "v"});
  WorkerThread worker(exchange, "worker");
  const auto transport = join(exchange, Role::coordinator, "coordinator");
  RunObserver silent;
  const std::atomic<bool> interrupt{false};
  const RunResult result =
      EvolutionRun(*transport, data, silent).run(interrupt, {.idle = std::chrono::milliseconds(200)});
  EXPECT_EQ(result.end, RunEnd::finished);
  EXPECT_TRUE(same_fronts(run_in_memory(data, 1), result));
}

}  // namespace
}  // namespace demecal
