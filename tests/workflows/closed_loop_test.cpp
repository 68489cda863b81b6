// A calibration closes its loop: it finds what no job declared, from the measured poses alone.
#include <gtest/gtest.h>

#include <algorithm>

#include "config/model_file.hpp"
#include "scheduling/in_memory_pool.hpp"
#include "workflows/lacking_puma.hpp"

namespace demecal {
namespace {

TEST(ClosedLoop, NamesUndeclaredBacklashAndLowersTheErrorOnPosesNeverLookedAt) {
  const DataSet data = simulate(lacking_puma(true));
  const CalibrateResult result = calibrate_in_memory(data, short_looping_job());
  ASSERT_FALSE(result.loop.rounds.empty());
  EXPECT_EQ(result.loop.rounds.front().verdict, Verdict::added);
  EXPECT_TRUE(is_backlash_of_joint_2(result.loop.rounds.front().effect)) << result.loop.rounds.front().diagnosis;
  const auto found = std::ranges::find_if(result.model.robot.effects, is_backlash_of_joint_2);
  ASSERT_NE(found, result.model.robot.effects.end());
  EXPECT_NEAR(found->values[0], 5e-4, 1e-4);
  EXPECT_LT(accept_rms(result.model.robot, data), 0.8 * accept_rms(result.before, data));
}

TEST(ClosedLoop, AddsNothingToTheCleanTwin) {
  const CalibrateResult result = calibrate_in_memory(simulate(lacking_puma(false)), short_looping_job());
  EXPECT_TRUE(result.model.robot.effects.empty());
  EXPECT_NE(result.loop.stopped, StopReason::not_run);
  EXPECT_FALSE(result.loop.not_found.empty());
}

TEST(ClosedLoop, GivesTheSameModelWhateverTheWorkers) {
  const DataSet data = simulate(lacking_puma(true));
  Job job = short_looping_job();
  job.closed_loop.candidates = {"backlash", "coupling"};
  const CalibrateResult one = calibrate_in_memory(data, job, 1);
  EXPECT_FALSE(one.model.robot.effects.empty());
  for (const std::optional<double> share_work_from_s : {std::optional<double>{}, {0.0}})
    EXPECT_EQ(model_text(one.model), model_text(calibrate_in_memory(data, job, 3, share_work_from_s).model))
        << share_work_from_s.has_value();
}

TEST(ClosedLoop, DoesNotRunWhereNoEffectIsAllowed) {
  Job job = short_looping_job();
  job.closed_loop.max_effects = 0;
  const CalibrateResult result = calibrate_in_memory(simulate(lacking_puma(true)), job);
  EXPECT_EQ(result.loop.stopped, StopReason::not_run);
  EXPECT_TRUE(result.loop.rounds.empty());
  EXPECT_TRUE(result.model.robot.effects.empty());
}

TEST(ClosedLoop, CountsGenerationsOnWhereCorrectionsAreEvolvedAnew) {
  Job job = short_looping_job();
  job.closed_loop.candidates = {"backlash"};
  const CalibrateResult result = calibrate_in_memory(simulate(lacking_puma(true)), job);
  std::uint32_t last = 0;
  for (const Progress& progress : result.history) last = std::max(last, progress.generation);
  const auto generations = static_cast<std::uint32_t>(job.gp.number_generations);
  EXPECT_GT(last, generations);
  EXPECT_EQ(last % generations, 0U);
  EXPECT_EQ(result.facts.generations, result.facts.islands * last);
}

}  // namespace
}  // namespace demecal
