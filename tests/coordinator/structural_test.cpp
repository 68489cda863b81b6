// A calibration by transforms between the links, from measured poses to the files that other commands read.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>

#include "config/model_file.hpp"
#include "coordinator/result_folder.hpp"
#include "scheduling/in_memory_pool.hpp"
#include "terminal/report_text.hpp"
#include "workflows/lacking_puma.hpp"

namespace demecal {
namespace {

Job structural_job() {
  Job job;
  job.name = "structural";
  job.method = Method::structural;
  job.declared = {.registration = true, .joint_offset = true, .geometry = true};
  return job;
}

DataSet structured_puma() {
  DataSet data = simulate(load_scenario(DEMECAL_SOURCE_DIR "/configs/scenarios/structural.yaml"));
  data.sha256 = "of no file";
  return data;
}

/// Asks for no pool: none is there.
CalibrateResult calibrated(const DataSet& data, const Job& job, bool interrupted = false) {
  const std::atomic<bool> interrupt{interrupted};
  CalibrateOptions options;
  return calibrate(
      data, job,
      []() -> std::unique_ptr<WorkerPool> {
        ADD_FAILURE() << "a pool was asked for";
        return nullptr;
      },
      interrupt, options);
}

double accept_mm(const CorrectedRobot& robot, const DataSet& data) {
  return error_figures(robot, data, poses_of(data, PoseSet::accept)).mean_mm;
}

TEST(Structural, LeavesLessOnAcceptPosesThanOffsetsAndGeometryDo) {
  const DataSet data = structured_puma();
  const CalibrateResult result = calibrated(data, structural_job());
  EXPECT_EQ(result.end, RunEnd::finished);
  EXPECT_FALSE(result.structure.empty());
  EXPECT_LT(accept_mm(result.model.robot, data), accept_mm(result.preparation.declared.robot, data));
  EXPECT_LT(accept_mm(result.model.robot, data), 0.2 * accept_mm(result.preparation.registered.robot, data));
}

TEST(Structural, WritesAModelThatPredictsTheSameAndAReportThatNamesTheTransforms) {
  const DataSet data = structured_puma();
  const CalibrateResult result = calibrated(data, structural_job());
  const auto folder = std::filesystem::temp_directory_path() / ("demecal-structural-" + std::to_string(::getpid()));
  std::filesystem::create_directories(folder);
  const Report report = write_results(folder, data, result);
  const CalibratedModel model = load_model(folder / "model.yaml");
  EXPECT_EQ(model.method, Method::structural);
  EXPECT_NEAR(accept_mm(model.robot, data), accept_mm(result.model.robot, data), 1e-6);
  EXPECT_FALSE(std::filesystem::exists(folder / "history.csv"));
  std::filesystem::remove_all(folder);
  const std::string json = to_json(report), words = to_terminal(report);
  for (const FoundTransform& transform : result.structure) {
    EXPECT_THAT(json, testing::HasSubstr('"' + transform.name() + '"'));
    EXPECT_THAT(words, testing::HasSubstr(transform.name()));
  }
  EXPECT_THAT(words, testing::HasSubstr("with the structure found"));
}

TEST(Structural, KeepsWhatItHasWhenInterrupted) {
  const DataSet data = structured_puma();
  const CalibrateResult result = calibrated(data, structural_job(), true);
  EXPECT_EQ(result.end, RunEnd::interrupted);
  EXPECT_EQ(result.facts.generations, 1U);
  EXPECT_LT(accept_mm(result.model.robot, data), accept_mm(result.preparation.registered.robot, data));
}

}  // namespace
}  // namespace demecal
