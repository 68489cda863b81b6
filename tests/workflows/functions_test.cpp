// Calibrations whose joints share functions: the same whatever the workers, taken up from a journal, and written down.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "../config/temporary_folder.hpp"
#include "config/model_file.hpp"
#include "expression/text.hpp"
#include "scheduling/in_memory_pool.hpp"
#include "workflows/lacking_puma.hpp"

namespace demecal {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

/// The demo's PUMA, the errors of all its joints waves of their own size, number of turns and phase.
DataSet waving_puma(bool backlash = false) {
  Scenario scenario = lacking_puma(backlash);
  scenario.joint_errors.clear();
  for (int joint = 0; joint < 6; ++joint) {
    const std::string turns = std::to_string(1.5 + 0.2 * joint), phase = std::to_string(0.4 * joint - 1.0);
    scenario.joint_errors.push_back({joint, parse("0.003 * SIN(" + turns + " * theta + " + phase + ")")});
  }
  return simulate(scenario);
}

Job sharing_job() {
  Job job = short_looping_job();
  job.closed_loop.max_effects = 0;
  job.gp.constants = ConstantPolicy::lamarckian;
  job.gp.constant_share = 0.2;
  job.gp.functions = {Primitive::add, Primitive::multiply, Primitive::sine};
  job.corrections.sharing = {.functions = 2, .stages = 3};
  return job;
}

TEST(SharedFunctions, OfAModelAreTheSameWhateverTheWorkers) {
  const DataSet data = waving_puma();
  const CalibrateResult one = calibrate_in_memory(data, sharing_job(), 1);
  const CalibrateResult three = calibrate_in_memory(data, sharing_job(), 3);
  EXPECT_EQ(one.end, RunEnd::finished);
  ASSERT_TRUE(one.model.functions);
  EXPECT_FALSE(one.model.functions->empty());
  EXPECT_EQ(one.facts.generations, 30U * one.facts.islands);
  const std::string text = model_text(one.model);
  EXPECT_EQ(text, model_text(three.model));
  EXPECT_THAT(text, HasSubstr("shared_functions:\n  - {definition: "));
}

TEST(SharedFunctions, NotAskedForLeaveTheModelAsItIsWithoutThem) {
  const DataSet data = waving_puma();
  Job job = sharing_job();
  job.corrections.sharing = {.functions = 0, .stages = 5};
  job.gp.shared_function_weight = 3.0;
  Job plain = job;
  plain.corrections.sharing = {};
  plain.gp.shared_function_weight = 1.0;
  const std::string text = model_text(calibrate_in_memory(data, job).model);
  EXPECT_EQ(text, model_text(calibrate_in_memory(data, plain).model));
  EXPECT_THAT(text, Not(HasSubstr("functions")));
}

TEST(SharedFunctions, AreFoundBetweenTheRoundsOfDistalLearning) {
  const DataSet data = waving_puma();
  Job job = sharing_job();
  job.method = Method::distal;
  job.distal.rounds = 3;
  const CalibrateResult one = calibrate_in_memory(data, job, 1), three = calibrate_in_memory(data, job, 3);
  ASSERT_TRUE(one.model.functions);
  EXPECT_FALSE(one.model.functions->empty());
  EXPECT_EQ(model_text(one.model), model_text(three.model));
}

TEST(SharedFunctions, StayAsTheyAreWhileTheLoopIsClosed) {
  const DataSet data = waving_puma(true);
  Job job = sharing_job();
  const CalibrateResult open = calibrate_in_memory(data, job);
  job.closed_loop.max_effects = 100;
  job.closed_loop.candidates = {"backlash"};
  const CalibrateResult closed = calibrate_in_memory(data, job, 3);
  EXPECT_FALSE(closed.model.robot.effects.empty());
  EXPECT_EQ(closed.model.functions, open.model.functions);
}

TEST(SharedFunctions, OfARunThatTheJournalHoldsAreFoundAgainWithoutWorkers) {
  const DataSet data = waving_puma();
  const TemporaryFolder folder;
  const JobIdentity identity{.data_sha256 = "d", .job_sha256 = "j", .seed = 5, .version = "v"};
  const std::atomic<bool> interrupt{false};
  const auto calibrated = [&](RunJournal::Start start, int workers) {
    RunJournal journal(folder.path().string(), identity, start);
    CalibrateOptions options;
    options.journal = &journal;
    const auto make_pool = [workers] { return std::make_unique<InMemoryWorkerPool>(workers); };
    return model_text(calibrate(data, sharing_job(), make_pool, interrupt, options).model);
  };
  const std::string first = calibrated(RunJournal::Start::anew, 2);
  EXPECT_EQ(calibrated(RunJournal::Start::resume, 0), first);
}

}  // namespace
}  // namespace demecal
