// Explanations that are evolved by workers are, to the bit, those that one process finds, whatever befalls the workers.
#include <gtest/gtest.h>

#include <atomic>

#include "../config/temporary_folder.hpp"
#include "../effect_sets/deceptive.hpp"
#include "disturbed_run.hpp"
#include "explanations/explanation_search.hpp"
#include "in_memory_pool.hpp"
#include "scheduling/island_evolver.hpp"
#include "scheduling/worker_pool.hpp"

namespace demecal {
namespace {

SetSearch long_search() {
  return set_search({1, 2, 7}, {.variations = 3000}, RandomStream{9});
}

std::vector<EffectSet> searched(const ExplanationProblem& problem, const MakeWorkerPool& make_pool,
                                const EvolverOptions& options = {}) {
  const std::atomic<bool> interrupt{false};
  const Job job;
  IslandEvolver evolver(job, make_pool, interrupt, options);
  return evolver.search_explanations(problem, long_search());
}

TEST(Explanations, AreTheSameWhoeverEvolvesThem) {
  const ExplanationProblem problem = deceptive(31);
  const std::vector<EffectSet> alone = search_explanations(problem, long_search());
  EXPECT_GT(alone.size(), 3U);
  for (const int workers : {1, 2, 5})
    EXPECT_EQ(searched(problem, [=] { return std::make_unique<InMemoryWorkerPool>(workers); }), alone) << workers;
  for (const std::uint32_t threads : {1U, 3U})
    EXPECT_EQ(searched(problem, [=] { return std::make_unique<InProcessWorkerPool>(threads); }), alone) << threads;
}

TEST(Explanations, AreEvolvedHereWhereNoWorkerComes) {
  const ExplanationProblem problem = deceptive(32);
  EvolverOptions options;
  options.patience.worker = std::chrono::milliseconds(50);
  EXPECT_EQ(searched(
                problem, [] { return std::make_unique<InMemoryWorkerPool>(0); }, options),
            search_explanations(problem, long_search()));
}

TEST(Explanations, AreEvolvedHereWhereNoWorkerCanBeStarted) {
  const ExplanationProblem problem = deceptive(34);
  const MakeWorkerPool none = []() -> std::unique_ptr<WorkerPool> { throw std::runtime_error("no program"); };
  EXPECT_EQ(searched(problem, none), search_explanations(problem, long_search()));
}

TEST(Explanations, AreTheSameWhateverBefallsTheRun) {
  const ExplanationProblem problem = deceptive(33);
  CalibrationData data = data_of_search(problem, long_search());
  data.run = 1;
  const RunResult undisturbed = run_in_memory(data, 1);
  int killed = 0, resumed = 0;
  for (std::uint64_t schedule = 0; schedule < 40; ++schedule) {
    const TemporaryFolder folder;
    DisturbedRun disturbed(data, folder.path().string(), schedule);
    const RunResult result = disturbed.run();
    ASSERT_EQ(result.end, RunEnd::finished) << "schedule " << schedule << ":\n" << disturbed.happened().told;
    ASSERT_TRUE(same_fronts(undisturbed, result)) << "schedule " << schedule;
    killed += disturbed.happened().killed;
    resumed += disturbed.happened().resumed;
  }
  EXPECT_GT(killed, 5);
  EXPECT_GT(resumed, 5);
}

}  // namespace
}  // namespace demecal
