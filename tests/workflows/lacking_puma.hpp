// The demo's PUMA measured more often: smooth joint errors, and backlash that no job declares.
#pragma once

#include "config/scenario_file.hpp"
#include "prediction/measurement.hpp"
#include "scheduling/in_memory_pool.hpp"
#include "simulation/simulated_robot.hpp"
#include "workflows/workflows.hpp"

namespace demecal {

/// `backlash` false: the same without backlash.
inline Scenario lacking_puma(bool backlash) {
  Scenario scenario = load_scenario(DEMECAL_SOURCE_DIR "/configs/scenarios/demo.yaml");
  scenario.poses = {100, 60, 40};
  if (!backlash) scenario.backlash.clear();
  return scenario;
}

inline Job short_looping_job() {
  Job job;
  job.name = "short";
  job.seed = 5;
  job.gp.population_size = 60;
  job.gp.number_generations = 30;
  job.closed_loop.highest_ratio = 30;
  return job;
}

inline double accept_rms(const CorrectedRobot& robot, const DataSet& data) {
  return error_figures(robot, data, poses_of(data, PoseSet::accept)).rms_mm;
}

inline bool is_backlash_of_joint_2(const Effect& effect) {
  return effect.kind == "backlash" && effect.joint == 1;
}

/// The whole calibration of `data`, without files and processes.
inline CalibrateResult calibrate_in_memory(const DataSet& data, const Job& job, int workers = 2,
                                           std::optional<double> share_work_from_s = {}) {
  const std::atomic<bool> interrupt{false};
  CalibrateOptions options;
  options.share_work_from_s = share_work_from_s;
  return calibrate(
      data, job, [workers] { return std::make_unique<InMemoryWorkerPool>(workers); }, interrupt, options);
}

}  // namespace demecal
