// A study's runs are the calibrations that its jobs give alone, and what was reached outlasts an interruption.
#include "workflows/workflows.hpp"

#include <gtest/gtest.h>

#include "scheduling/in_memory_pool.hpp"
#include "workflows/lacking_puma.hpp"

namespace demecal {
namespace {

std::vector<Job> two_jobs() {
  Job job = short_looping_job();
  job.closed_loop.max_effects = 0;
  job.gp.population_size = 20;
  job.gp.number_generations = 20;
  Job other = job;
  other.gp.population_size = 30;
  other.islands.per_joint = 1;
  return {job, other};
}

const auto kMakeWorkerPool = [] { return std::make_unique<InMemoryWorkerPool>(2); };

void expect_same_figures(const StudyRun& a, const StudyRun& b) {
  EXPECT_EQ(a.calibration_mm, b.calibration_mm);
  EXPECT_EQ(a.validation_mm, b.validation_mm);
  EXPECT_EQ(a.accept_mm, b.accept_mm);
  EXPECT_EQ(a.nodes, b.nodes);
  EXPECT_EQ(a.corrected, b.corrected);
  EXPECT_EQ(a.evaluations, b.evaluations);
}

TEST(Study, HasTheFiguresOfItsJobsAlone) {
  const DataSet data = simulate(lacking_puma(false));
  const std::vector<Job> jobs = two_jobs();
  const std::vector<std::uint64_t> seeds{11, 12};
  const std::atomic<bool> interrupt{false};
  std::size_t told = 0;
  const StudyOutcome outcome = run_study(data, jobs, seeds, kMakeWorkerPool, interrupt, {},
                                         [&](const StudyOutcome& reached) { EXPECT_EQ(reached.runs.size(), ++told); });
  EXPECT_EQ(outcome.end, RunEnd::finished);
  ASSERT_EQ(outcome.runs.size(), 4U);
  EXPECT_EQ(told, 4U);
  std::size_t islands = 0;
  for (std::size_t i = 0; i < 4; ++i) {
    EXPECT_EQ(outcome.runs[i].cell, i % 2);
    EXPECT_EQ(outcome.runs[i].seed, seeds[i / 2]);
    Job job = jobs[i % 2];
    job.seed = seeds[i / 2];
    const CalibrateResult alone = calibrate_in_memory(data, job, 1);
    expect_same_figures(outcome.runs[i], figures_of(data, alone));
    EXPECT_GT(outcome.runs[i].evaluations, 0U);
    islands += alone.fronts.size();
  }
  EXPECT_EQ(outcome.fronts.size(), islands);
  EXPECT_NE(outcome.runs[0].validation_mm, outcome.runs[2].validation_mm);
}

TEST(Study, FindsExpressionsThatItsJointsShare) {
  const DataSet data = simulate(lacking_puma(false));
  const std::vector<std::uint64_t> seeds{11};
  const std::atomic<bool> interrupt{false};
  const StudyOutcome outcome =
      run_study(data, two_jobs(), seeds, kMakeWorkerPool, interrupt, {}, [](const StudyOutcome&) {});
  const std::vector<BuildingBlock> blocks = building_blocks(outcome.fronts);
  ASSERT_FALSE(blocks.empty());
  EXPECT_GE(blocks.front().joints, 2U);
  EXPECT_LE(blocks.front().islands, outcome.fronts.size());
}

TEST(Study, KeepsWhatWasReachedWhenItIsInterrupted) {
  const DataSet data = simulate(lacking_puma(false));
  const std::vector<std::uint64_t> seeds{11, 12};
  std::atomic<bool> interrupt{false};
  const StudyOutcome outcome = run_study(data, two_jobs(), seeds, kMakeWorkerPool, interrupt, {},
                                         [&](const StudyOutcome& reached) { interrupt = reached.runs.size() == 3; });
  EXPECT_EQ(outcome.end, RunEnd::interrupted);
  EXPECT_EQ(outcome.runs.size(), 3U);
}

}  // namespace
}  // namespace demecal
