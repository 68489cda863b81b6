#include "coordinator/evolutions.hpp"

#include <unistd.h>

#include <algorithm>

#include "coordinator/progress_display.hpp"

namespace demecal {
namespace {

/// A new name for every run: who started it, and when. It tells runs apart and has no part in the result.
RunId new_run() {
  const auto moment = std::chrono::system_clock::now().time_since_epoch().count();
  return (static_cast<RunId>(moment) << 16) ^ static_cast<RunId>(::getpid()) ^ 1U;
}

CalibrationData calibration_data(const Job& job, const std::vector<JointTraining>& trainings) {
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
  for (const JointTraining& training : trainings) {
    data.archipelago.joints.push_back(training.joint);
    data.tables.push_back(training.table);
  }
  return data;
}

std::vector<JointCandidates> candidates_of(const std::vector<JointTraining>& trainings, const RunResult& run) {
  std::vector<JointCandidates> candidates;
  for (const JointTraining& training : trainings) {
    ParetoFront front;
    for (const auto& [island, members] : run.fronts) {
      if (island.joint != training.joint) continue;
      for (const Individual& member : members) front.offer(member);
    }
    candidates.push_back({training, front.members()});
  }
  return candidates;
}

}  // namespace

std::vector<JointCandidates> Evolutions::run(const std::vector<JointTraining>& training) {
  if (training.empty()) return {};
  const CalibrationData data = calibration_data(job_, training);
  ProgressDisplay display(stderr, data, options_.quiet);
  const std::unique_ptr<Fleet> fleet = make_fleet_();
  fleet->launch(data.run);
  RunResult result = EvolutionRun(fleet->transport(), data, display).run(interrupt_, options_.worker_patience);
  display.finish();
  std::vector<JointCandidates> candidates = candidates_of(training, result);
  note(result);
  return candidates;
}

void Evolutions::note(RunResult& result) {
  end_ = result.end;
  for (Progress& progress : result.history) {
    progress.generation += runs_ * static_cast<std::uint32_t>(job_.gp.number_generations);
    history_.push_back(std::move(progress));
  }
  facts_.workers = std::max(facts_.workers, result.workers);
  facts_.islands = std::max(facts_.islands, result.fronts.size());
  facts_.generations += result.generations;
  facts_.evaluations += result.evaluations;
  facts_.migrations += result.migrations;
  ++runs_;
}

}  // namespace demecal
