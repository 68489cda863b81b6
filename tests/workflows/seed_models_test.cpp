// An earlier model's corrections are what islands begin from, where a job names the model's file.
#include <gtest/gtest.h>

#include <algorithm>

#include "../config/temporary_folder.hpp"
#include "config/job_file.hpp"
#include "config/model_file.hpp"
#include "scheduling/in_memory_pool.hpp"
#include "workflows/lacking_puma.hpp"

namespace demecal {
namespace {

/// A job that begins from the models in `files`, as its file says it.
Job job_from(const TemporaryFolder& folder, const std::string& files) {
  Job job = load_job(folder.write("job.yaml",
                                  "demecal_job: 1\ndata: poses.yaml\nclosed_loop: {max_effects: 0}\n"
                                  "gp: {population_size: 60, number_generations: 1, seed_models: [" +
                                      files + "]}\n"));
  job.seed = 12;
  return job;
}

class SeedModels : public testing::Test {
 protected:
  SeedModels() {
    Job job = short_looping_job();
    job.closed_loop.max_effects = 0;
    data.sha256 = "of no file";
    earlier = calibrate_in_memory(data, job).model;
    folder.write("earlier.yaml", model_text(earlier));
  }

  DataSet data = simulate(lacking_puma(false));
  const TemporaryFolder folder;
  CalibratedModel earlier;
};

TEST_F(SeedModels, CorrectionsStandInTheFirstPopulationsOfTheirJoints) {
  const Job job = job_from(folder, "earlier.yaml");
  std::size_t seeded = 0;
  for (const JointTraining& training : prepare(data, job).training) {
    const JointCorrection& correction = earlier.robot.corrections[training.joint];
    ASSERT_EQ(training.table.seeds.size(), correction.is_neutral() ? 0U : 1U);
    if (correction.is_neutral()) continue;
    ++seeded;
    const Tree& seed = training.table.seeds.front();
    const JointCorrection again = correction_from(training, seed);
    for (const double theta : training.table.variables[0]) EXPECT_NEAR(again(theta), correction(theta), 1e-12);
    Archipelago archipelago;
    archipelago.joints = {training.joint};
    Island island(job.gp, archipelago, training.table, {training.joint, 0}, job.seed);
    island.run_epoch({});
    const Population& first = island.state().population;
    const auto found = std::ranges::find(first, seed, &Individual::tree);
    ASSERT_NE(found, first.end()) << "joint " << training.joint;
    EXPECT_EQ(found->fitness, Fitness(training.table)(seed));
  }
  EXPECT_GE(seeded, 3U);
}

TEST_F(SeedModels, LeaveNoMoreErrorAfterOneGenerationThanTheModelThatWasBegunFrom) {
  const CalibrateResult result = calibrate_in_memory(data, job_from(folder, "earlier.yaml"));
  const std::vector<std::size_t> validation = poses_of(data, PoseSet::validation);
  const double before = error_figures(earlier.robot, data, validation).rms_mm;
  const double unseeded =
      error_figures(calibrate_in_memory(data, job_from(folder, "")).model.robot, data, validation).rms_mm;
  EXPECT_LE(error_figures(result.model.robot, data, validation).rms_mm, 1.02 * before);
  EXPECT_GT(unseeded, 1.15 * before);
}

}  // namespace
}  // namespace demecal
