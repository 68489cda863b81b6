#include "coordinator/calibrate.hpp"

#include <unistd.h>

#include "coordinator/progress_display.hpp"

namespace demecal {
namespace {

using Clock = std::chrono::steady_clock;

/// A new name for every run: who started it, and when. It tells runs apart and has no part in the result.
RunId new_run() {
  const auto moment = std::chrono::system_clock::now().time_since_epoch().count();
  return (static_cast<RunId>(moment) << 16) ^ static_cast<RunId>(::getpid()) ^ 1U;
}

CalibrationData calibration_data(const Job& job, const Preparation& preparation) {
  CalibrationData data;
  data.run = new_run();
  data.job = job.name;
  data.seed = job.seed;
  data.parameters = job.gp;
  data.archipelago.demes_per_joint = job.islands.per_joint;
  data.archipelago.topology = job.islands.topology;
  data.archipelago.migration_interval = job.islands.migration_interval;
  data.archipelago.migrants = job.islands.migrants;
  data.archipelago.between_joints = job.islands.between_joints;
  for (const JointTraining& training : preparation.training) {
    data.archipelago.joints.push_back(training.joint);
    data.tables.push_back(training.table);
  }
  return data;
}

std::vector<JointCandidates> candidates_of(const Preparation& preparation, const RunResult& run) {
  std::vector<JointCandidates> candidates;
  for (const JointTraining& training : preparation.training) {
    ParetoFront front;
    for (const auto& [island, members] : run.fronts) {
      if (island.joint != training.joint) continue;
      for (const Individual& member : members) front.offer(member);
    }
    candidates.push_back({training, front.members()});
  }
  return candidates;
}

CalibratedModel model_of(const DataSet& data, const Job& job, const Calibration& calibration) {
  return {.job = job.name,
          .nominal = data.robot,
          .method = job.method,
          .declared = job.declared,
          .robot = calibration.robot,
          .estimates = calibration.estimates,
          .joints = calibration.joints,
          .data_name = data.name,
          .data_sha256 = data.sha256,
          .seed = job.seed,
          .version = DEMECAL_VERSION};
}

RunResult evolve(const CalibrationData& data, const std::function<std::unique_ptr<Fleet>()>& make_fleet,
                 const std::atomic<bool>& interrupt, const CalibrateOptions& options) {
  ProgressDisplay display(stderr, data, options.quiet);
  const std::unique_ptr<Fleet> fleet = make_fleet();
  fleet->launch(data.run);
  RunResult result = EvolutionRun(fleet->transport(), data, display).run(interrupt, options.worker_patience);
  display.finish();
  return result;
}

}  // namespace

CalibrateResult calibrate(const DataSet& data, const Job& job,
                          const std::function<std::unique_ptr<Fleet>()>& make_fleet, const std::atomic<bool>& interrupt,
                          const CalibrateOptions& options) {
  const Clock::time_point begin = Clock::now();
  CalibrateResult result;
  result.preparation = prepare(data, job);
  RunResult run;
  if (!result.preparation.training.empty()) {
    run = evolve(calibration_data(job, result.preparation), make_fleet, interrupt, options);
  }
  result.end = run.end;
  result.calibration = conclude(data, job, result.preparation, candidates_of(result.preparation, run));
  result.model = model_of(data, job, result.calibration);
  result.history = std::move(run.history);
  result.facts = {.wall_s = std::chrono::duration<double>(Clock::now() - begin).count(),
                  .workers = run.workers,
                  .islands = run.fronts.size(),
                  .generations = run.generations,
                  .evaluations = run.evaluations,
                  .migrations = run.migrations,
                  .interrupted = run.end == RunEnd::interrupted};
  return result;
}

}  // namespace demecal
