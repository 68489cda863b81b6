#include "effects/effect.hpp"
#include "workflows/workflows.hpp"

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <atomic>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "calibration/calibration.hpp"
#include "calibration/evolver.hpp"
#include "calibration/job.hpp"
#include "calibration/selection.hpp"
#include "calibration/shared_functions.hpp"
#include "calibration/training.hpp"
#include "closed_calibration/calibrated_model.hpp"
#include "closed_calibration/closed_calibration.hpp"
#include "data/data_set.hpp"
#include "diagnosis/candidates.hpp"
#include "diagnosis/outcome.hpp"
#include "distal/learning.hpp"
#include "distal/steps.hpp"
#include "effect_sets/fitted_set.hpp"
#include "effect_sets/set_island.hpp"
#include "evolution/archipelago.hpp"
#include "evolution/population.hpp"
#include "explanations/explanation_search.hpp"
#include "expression/shared_function.hpp"
#include "fitness/parameters.hpp"
#include "fitting/fit.hpp"
#include "fitting/stations.hpp"
#include "parameters/declared_model.hpp"
#include "parameters/posterior.hpp"
#include "prediction/corrected_robot.hpp"
#include "protocol/messages.hpp"
#include "report/make_report.hpp"
#include "scheduling/island_evolver.hpp"
#include "scheduling/run_state.hpp"
#include "scheduling/worker_pool.hpp"

namespace demecal::inline workflows {
namespace {

using Clock = std::chrono::steady_clock;

/// `search`: of the searches for the null distribution, which this is, from 1.
std::string search_words(Purpose purpose, int search) {
  if (purpose == Purpose::corrections) return "evolving the joint corrections anew beside the effects";
  if (purpose == Purpose::formulas) return "evolving formulas over all circumstances on what is left";
  return "the same search on permuted poses, to know what chance finds: number " + std::to_string(search);
}

/// Whether the corrections are evolved by workers, and not in this process.
bool evolves_on_islands(const Job& job) {
  return job.declared.joint_corrections && (job.method != Method::distal || job.distal.form == DistalForm::parallel);
}

std::string sharing_words(const std::vector<SharedFunction>& functions) {
  if (functions.empty()) return "no structure shortens formulas of two joints: no function is shared yet";
  std::string words = "joints share";
  for (std::size_t i = 0; i < functions.size(); ++i) words += (i == 0 ? " " : "; ") + definition_text(functions[i], i);
  return words;
}

/// The islands, with words for people about what the closed loop has them evolve.
class AnnouncedEvolver final : public Evolver {
 public:
  AnnouncedEvolver(IslandEvolver& islands, CalibrationObserver& observer) : islands_(islands), observer_(observer) {}

  EvolvedJoints evolve(const std::vector<JointTraining>& trainings, const EvolutionTerms& terms) override {
    EvolvedJoints evolved = islands_.evolve(trainings, terms);
    if (islands_.end() == RunEnd::no_worker)
      observer_.on_message("no worker is left: the loop's own corrections are kept");
    return evolved;
  }
  std::vector<EffectSet> search_explanations(const ExplanationProblem& problem, const SetSearch& search) override {
    observer_.on_message("evolving explanations: which causes, and how few");
    std::vector<EffectSet> found = islands_.search_explanations(problem, search);
    if (!islands_.searched_here_because().empty())
      observer_.on_message("explanations were evolved in this process: " + islands_.searched_here_because());
    return found;
  }
  std::vector<std::vector<double>> do_work(const SharedWork& work) override { return islands_.do_work(work); }
  void announce(Purpose purpose) override {
    if (purpose == Purpose::null_distribution) ++null_searches_;
    observer_.on_message(search_words(purpose, null_searches_));
  }
  void announce_loop_without_corrections() override {
    observer_.on_message("the closed loop once more, without the joint corrections that were evolved before it");
  }
  bool is_interrupted() const override { return islands_.is_interrupted(); }
  void add_effort(std::uint32_t generations, std::uint64_t evaluations) override {
    islands_.add_effort(generations, evaluations);
  }

 private:
  IslandEvolver& islands_;
  CalibrationObserver& observer_;
  int null_searches_ = 0;
};

/// Stages of evolution, each but the first with words for people about the functions it has.
class StagedEvolver final : public Evolver {
 public:
  StagedEvolver(Evolver& evolver, CalibrationObserver& observer) : evolver_(evolver), observer_(observer) {}

  EvolvedJoints evolve(const std::vector<JointTraining>& trainings, const EvolutionTerms& terms) override {
    if (!std::exchange(first_, false)) observer_.on_message(sharing_words(terms.functions));
    return evolver_.evolve(trainings, terms);
  }

 private:
  Evolver& evolver_;
  CalibrationObserver& observer_;
  bool first_ = true;
};

/// In stages where joints are to share functions.
std::vector<JointCandidates> learn_directly(const DataSet& data, const Job& job, IslandEvolver& islands,
                                            CalibrationObserver& observer, CalibrateResult& result) {
  const std::vector<JointTraining>& training = result.preparation.training;
  if (job.corrections.sharing.functions == 0)
    return islands.evolve(training, {job.seed, job.gp.number_generations}).joints;
  observer.on_learning_begins(data.robot);
  StagedEvolver evolver(islands, observer);
  StagedOutcome outcome = learn_in_stages(training, job, evolver);
  result.functions = std::move(outcome.functions);
  return std::move(outcome.candidates);
}

/// What islands or this process evolved for every joint, by the job's method; the run's end is in `islands`.
std::vector<JointCandidates> learn(const DataSet& data, const Job& job, IslandEvolver& islands,
                                   CalibrationObserver& observer, CalibrateResult& result) {
  if (job.method != Method::distal) {
    std::vector<JointCandidates> candidates = learn_directly(data, job, islands, observer, result);
    add_choices_of_all_joints(data, result.preparation, candidates);
    return candidates;
  }
  DistalOutcome outcome = learn_distally(data, job, result.preparation, islands);
  result.distal = std::move(outcome.steps);
  if (job.corrections.sharing.functions > 0) result.functions = std::move(outcome.functions);
  return std::move(outcome.candidates);
}

/// What sharing came to, where there was any.
void announce_shared_work(const IslandEvolver& islands, CalibrationObserver& observer) {
  const IslandEvolver::ShareOfWorkers& share = islands.share_of_workers();
  if (share.pieces == 0) return;
  observer.on_message("workers did " + std::to_string(share.elsewhere) + " of " + std::to_string(share.pieces) +
                      " pieces of the closed loop's scans, draws and resamplings");
}

/// Closes the loop around result.calibration.
void close_the_loop(const DataSet& data, const Job& job, IslandEvolver& islands, const std::atomic<bool>& interrupt,
                    CalibrationObserver& observer, CalibrateResult& result) {
  observer.on_learning_begins(data.robot);
  const auto watch = [&](const Round& round) {
    observer.on_round(round, data.robot);
    return !interrupt;
  };
  AnnouncedEvolver evolver(islands, observer);
  ClosedCalibration closed =
      close_calibration(data, job, result.preparation, result.calibration, evolver, watch, result.functions);
  result.before = std::move(closed.before);
  result.calibration = std::move(closed.calibration);
  result.loop = std::move(closed.loop);
  if (closed.best) result.best = make_model(data, job, *closed.best);
  if (interrupt) result.end = RunEnd::interrupted;
}

/// By the closed loop alone: nothing but explanations is evolved.
CalibrateResult calibrate_without_corrections(const DataSet& data, const Job& job, IslandEvolver& islands,
                                              const std::atomic<bool>& interrupt, CalibrationObserver& observer) {
  observer.on_learning_begins(data.robot);
  AnnouncedEvolver evolver(islands, observer);
  const auto watch = [&](const Round& round) {
    observer.on_round(round, data.robot);
    return !interrupt;
  };
  Diagnosis diagnosis = diagnose(data, job, std::nullopt, watch, work_of(evolver));
  islands.dismiss_workers();
  announce_shared_work(islands, observer);
  CalibrateResult& result = diagnosis.result;
  if (interrupt) result.end = RunEnd::interrupted;
  RunFacts facts = islands.facts();
  facts.wall_s = result.facts.wall_s;
  facts.interrupted = result.end == RunEnd::interrupted;
  result.facts = std::move(facts);
  return std::move(result);
}

/// The placement that a model file gives back to the bit: the rotation of a quaternion that it turns into again.
Eigen::Isometry3d as_files_have_it(Eigen::Isometry3d placement) {
  Eigen::Quaterniond turn(placement.linear());
  for (int left = 100; left > 0; --left) {
    const Eigen::Quaterniond again(turn.normalized().toRotationMatrix());
    if (again.coeffs() == turn.coeffs()) break;
    turn = again;
  }
  placement.linear() = turn.normalized().toRotationMatrix();
  return placement;
}

std::vector<Station> as_files_have_it(std::vector<Station> stations) {
  for (Station& station : stations) station.first_from_own = as_files_have_it(station.first_from_own);
  return stations;
}

CorrectedRobot as_files_have_it(CorrectedRobot robot) {
  robot.sensor_from_base = as_files_have_it(robot.sensor_from_base);
  for (auto& [target, tool] : robot.tools) tool = as_files_have_it(tool);
  return robot;
}

}  // namespace

CalibratedModel make_model(const DataSet& data, const Job& job, const Calibration& calibration) {
  return {.job = job.name,
          .nominal = data.robot,
          .method = job.method,
          .declared = job.declared,
          .robot = as_files_have_it(calibration.robot),
          .estimates = calibration.estimates,
          .joints = calibration.joints,
          .posterior = posterior_of(data, job.declared, calibration),
          .interval = interval_of(data, job.declared, calibration),
          .measured = measured_ranges(data, calibration),
          .measured_gaps = measured_gaps(data, calibration),
          .pose_counts = pose_counts(data, calibration),
          .pose_marks = pose_marks(data),
          .certificate = job.certificate,
          .stations = as_files_have_it(stations_as_found(calibration.robot, data)),
          .data_name = data.name,
          .data_sha256 = data.sha256,
          .approach_recorded = evidence_of(data, poses_of(data, PoseSet::calibration)).approach,
          .seed = job.seed,
          .version = DEMECAL_VERSION};
}

CalibrateResult calibrate(const DataSet& data, const Job& job, const MakeWorkerPool& make_pool,
                          const std::atomic<bool>& interrupt, const CalibrateOptions& options) {
  const Clock::time_point begin = Clock::now();
  if (job.method == Method::structural) return calibrate_structurally(data, job, interrupt, options);
  CalibrationObserver nobody;
  CalibrationObserver& observer = options.observer == nullptr ? nobody : *options.observer;
  IslandEvolver islands(
      job, make_pool, interrupt,
      {options.patience, options.asynchronous, &observer, options.journal, options.share_work_from_s});
  if (job.method == Method::diagnose) return calibrate_without_corrections(data, job, islands, interrupt, observer);
  CalibrateResult result;
  if (evolves_on_islands(job)) islands.start_workers();
  result.preparation = prepare(data, job);
  result.candidates = learn(data, job, islands, observer, result);
  result.end = islands.end();
  result.fronts = islands.take_fronts();
  result.calibration = conclude(data, job, result.preparation, result.candidates);
  result.before = result.calibration.robot;
  if (result.end == RunEnd::finished && job.closed_loop.max_effects > 0)
    close_the_loop(data, job, islands, interrupt, observer, result);
  islands.dismiss_workers();
  announce_shared_work(islands, observer);
  result.model = make_model(data, job, result.calibration);
  result.model.functions = result.functions;
  result.history = islands.take_history();
  result.facts = islands.facts();
  result.facts.wall_s = std::chrono::duration<double>(Clock::now() - begin).count();
  result.facts.interrupted = result.end == RunEnd::interrupted;
  result.facts.asynchronous = options.asynchronous;
  return result;
}

}  // namespace demecal::inline workflows
