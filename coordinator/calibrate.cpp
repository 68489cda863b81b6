#include "coordinator/calibrate.hpp"

#include <unistd.h>

#include <algorithm>
#include <optional>

#include "calibration/closed_calibration.hpp"
#include "coordinator/loop_display.hpp"
#include "coordinator/progress_display.hpp"

namespace demecal {
namespace {

using Clock = std::chrono::steady_clock;

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

/// The evolutions of one calibration, each a run of its own on a fleet of its own.
class Evolutions {
 public:
  Evolutions(const Job& job, const std::function<std::unique_ptr<Fleet>()>& make_fleet,
             const std::atomic<bool>& interrupt, const CalibrateOptions& options)
      : job_(job), make_fleet_(make_fleet), interrupt_(interrupt), options_(options) {}

  /// The candidates that the islands found, or had reached when the run ended; `end` says how it did.
  std::vector<JointCandidates> run(const std::vector<JointTraining>& training);
  RunEnd end() const { return end_; }
  /// Rows of all runs; the generations of a later one follow those of the earlier.
  std::vector<Progress> take_history() { return std::move(history_); }
  const RunFacts& facts() const { return facts_; }

 private:
  void note(RunResult& result);

  const Job& job_;
  const std::function<std::unique_ptr<Fleet>()>& make_fleet_;
  const std::atomic<bool>& interrupt_;
  const CalibrateOptions& options_;
  RunEnd end_ = RunEnd::finished;
  std::vector<Progress> history_;
  RunFacts facts_;
  std::uint32_t runs_ = 0;
};

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

/// Closes the loop around result.calibration.
void close_the_loop(const DataSet& data, const Job& job, Evolutions& evolutions, const std::atomic<bool>& interrupt,
                    const CalibrateOptions& options, CalibrateResult& result) {
  LoopDisplay display(stderr, data.robot, options.quiet);
  const auto watch = [&](const Round& round) {
    display.on_round(round);
    return !interrupt;
  };
  const Evolve evolve = [&](const std::vector<JointTraining>& training) {
    display.say("evolving the joint corrections anew beside the effects");
    std::optional<std::vector<JointCandidates>> candidates = evolutions.run(training);
    if (evolutions.end() == RunEnd::no_worker) display.say("no worker is left: the loop's own corrections are kept");
    if (evolutions.end() != RunEnd::finished) candidates.reset();
    return candidates;
  };
  ClosedCalibration closed = close_calibration(data, job, result.preparation, result.calibration, evolve, watch);
  result.before = std::move(closed.before);
  result.calibration = std::move(closed.calibration);
  result.loop = std::move(closed.loop);
  if (interrupt) result.end = RunEnd::interrupted;
}

}  // namespace

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

CalibrateResult calibrate(const DataSet& data, const Job& job,
                          const std::function<std::unique_ptr<Fleet>()>& make_fleet, const std::atomic<bool>& interrupt,
                          const CalibrateOptions& options) {
  const Clock::time_point begin = Clock::now();
  CalibrateResult result;
  result.preparation = prepare(data, job);
  Evolutions evolutions(job, make_fleet, interrupt, options);
  const std::vector<JointCandidates> candidates = evolutions.run(result.preparation.training);
  result.end = evolutions.end();
  result.calibration = conclude(data, job, result.preparation, candidates);
  result.before = result.calibration.robot;
  if (result.end == RunEnd::finished && job.closed_loop.max_effects > 0) {
    close_the_loop(data, job, evolutions, interrupt, options, result);
  }
  result.model = model_of(data, job, result.calibration);
  result.history = evolutions.take_history();
  result.facts = evolutions.facts();
  result.facts.wall_s = std::chrono::duration<double>(Clock::now() - begin).count();
  result.facts.interrupted = result.end == RunEnd::interrupted;
  return result;
}

}  // namespace demecal
