// A calibration by distal learning, from measured poses to a model.
#include <gtest/gtest.h>

#include "config/model_file.hpp"
#include "scheduling/in_memory_pool.hpp"
#include "workflows/lacking_puma.hpp"

namespace demecal {
namespace {

Job short_distal_job(DistalForm form) {
  Job job = short_looping_job();
  job.method = Method::distal;
  job.distal.form = form;
  job.distal.rounds = 3;
  return job;
}

/// From one generation that has steps to the next.
void expect_falling(const std::vector<DistalStep>& steps) {
  ASSERT_FALSE(steps.empty());
  for (std::size_t i = 1; i < steps.size(); ++i) {
    const bool is_of_the_same_round = steps[i].generation == steps[i - 1].generation;
    const double now = steps[i].index_mm2, last = steps[i - 1].index_mm2;
    EXPECT_TRUE(is_of_the_same_round ? now == last : now < last);
  }
}

TEST(Distal, GivesTheSameModelWhateverTheWorkers) {
  const DataSet data = simulate(lacking_puma(true));
  Job job = short_distal_job(DistalForm::parallel);
  job.closed_loop.candidates = {"backlash"};
  const CalibrateResult one = calibrate_in_memory(data, job, 1), three = calibrate_in_memory(data, job, 3);
  EXPECT_EQ(one.end, RunEnd::finished);
  EXPECT_FALSE(one.model.robot.effects.empty());
  EXPECT_EQ(model_text(one.model), model_text(three.model));
  expect_falling(one.distal);
}

TEST(Distal, ReachesAnAcceptErrorNoWorseThanDirectLearning) {
  const DataSet data = simulate(lacking_puma(false));
  Job job = short_looping_job();
  job.closed_loop.max_effects = 0;
  job.gp.population_size = 300;
  job.gp.number_generations = 60;
  const double by_direct = accept_rms(calibrate_in_memory(data, job).model.robot, data);
  job.method = Method::distal;
  const CalibrateResult result = calibrate_in_memory(data, job);
  EXPECT_EQ(result.model.method, Method::distal);
  EXPECT_LT(accept_rms(result.model.robot, data), 1.05 * by_direct);
}

TEST(Distal, InParallelReachesTheIndexOfTheSequence) {
  const DataSet data = simulate(lacking_puma(false));
  Job job = short_distal_job(DistalForm::parallel);
  job.closed_loop.max_effects = 0;
  const CalibrateResult parallel = calibrate_in_memory(data, job);
  job.distal.form = DistalForm::sequential;
  job.gp.number_generations *= 6;  // of all joints together
  const CalibrateResult sequential = calibrate_in_memory(data, job);
  expect_falling(parallel.distal);
  expect_falling(sequential.distal);
  EXPECT_EQ(sequential.end, RunEnd::finished);
  EXPECT_EQ(sequential.facts.generations, 180U);
  EXPECT_LT(accept_rms(sequential.model.robot, data), accept_rms(sequential.preparation.declared.robot, data));
  EXPECT_LE(parallel.distal.back().index_mm2, sequential.distal.back().index_mm2);
}

TEST(Distal, CountsTheGenerationsOfItsRoundsThrough) {
  Job job = short_distal_job(DistalForm::parallel);
  job.closed_loop.max_effects = 0;
  const CalibrateResult result = calibrate_in_memory(simulate(lacking_puma(false)), job);
  std::uint32_t last = 0;
  for (const Progress& progress : result.history) last = std::max(last, progress.generation);
  EXPECT_EQ(last, 30U);
  EXPECT_EQ(result.facts.generations, 30U * result.facts.islands);
}

}  // namespace
}  // namespace demecal
