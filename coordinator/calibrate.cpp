#include "coordinator/calibrate.hpp"

#include <optional>
#include <utility>

#include "calibration/shared_functions.hpp"
#include "closed_calibration/calibrated_model.hpp"
#include "closed_calibration/closed_calibration.hpp"
#include "coordinator/evolutions.hpp"
#include "coordinator/loop_display.hpp"
#include "coordinator/structural_learning.hpp"
#include "distal/learning.hpp"

namespace demecal {
namespace {

using Clock = std::chrono::steady_clock;

/// `search`: of the searches for the null distribution, which this is, from 1.
std::string to_string(Purpose purpose, int search) {
  if (purpose == Purpose::corrections) return "evolving the joint corrections anew beside the effects";
  if (purpose == Purpose::formulas) return "evolving formulas over all circumstances on what is left";
  return "the same search on permuted poses, to know what chance finds: number " + std::to_string(search);
}

/// Whether the corrections are evolved by workers, and not in this process.
bool evolves_on_islands(const Job& job) {
  return job.declared.joint_corrections && (job.method != Method::distal || job.distal.form == DistalForm::parallel);
}

std::string to_string(const std::vector<SharedFunction>& functions) {
  if (functions.empty()) return "no structure shortens formulas of two joints: no function is shared yet";
  std::string words = "joints share";
  for (std::size_t i = 0; i < functions.size(); ++i) words += (i == 0 ? " " : "; ") + definition_text(functions[i], i);
  return words;
}

/// The islands' evolutions, with words for people about what each is for.
class AnnouncedEvolver final : public Evolver {
 public:
  AnnouncedEvolver(Evolutions& evolutions, LoopDisplay& display) : evolutions_(evolutions), display_(display) {}

  EvolvedJoints evolve(const std::vector<JointTraining>& trainings, const EvolutionTerms& terms) override {
    EvolvedJoints evolved = evolutions_.evolve(trainings, terms);
    if (evolutions_.end() == RunEnd::no_worker) display_.say("no worker is left: the loop's own corrections are kept");
    return evolved;
  }
  void announce(Purpose purpose) override {
    if (purpose == Purpose::null_distribution) ++null_searches_;
    display_.say(to_string(purpose, null_searches_));
  }
  bool is_interrupted() const override { return evolutions_.is_interrupted(); }
  void add_effort(std::uint32_t generations, std::uint64_t evaluations) override {
    evolutions_.add_effort(generations, evaluations);
  }

 private:
  Evolutions& evolutions_;
  LoopDisplay& display_;
  int null_searches_ = 0;
};

/// Stages of evolution, each but the first with words for people about the functions it has.
class StagedEvolver final : public Evolver {
 public:
  StagedEvolver(Evolver& evolver, LoopDisplay& display) : evolver_(evolver), display_(display) {}

  EvolvedJoints evolve(const std::vector<JointTraining>& trainings, const EvolutionTerms& terms) override {
    if (!std::exchange(first_, false)) display_.say(to_string(terms.functions));
    return evolver_.evolve(trainings, terms);
  }

 private:
  Evolver& evolver_;
  LoopDisplay& display_;
  bool first_ = true;
};

/// In stages where joints are to share functions.
std::vector<JointCandidates> learn_directly(const DataSet& data, const Job& job, Evolutions& evolutions,
                                            const CalibrateOptions& options, CalibrateResult& result) {
  const std::vector<JointTraining>& training = result.preparation.training;
  if (job.corrections.sharing.functions == 0)
    return evolutions.evolve(training, {job.seed, job.gp.number_generations}).joints;
  LoopDisplay display(stderr, data.robot, options.quiet);
  StagedEvolver evolver(evolutions, display);
  StagedOutcome outcome = learn_in_stages(training, job, evolver);
  result.functions = std::move(outcome.functions);
  return std::move(outcome.candidates);
}

/// What islands or this process evolved for every joint, by the job's method; the run's end is in `evolutions`.
std::vector<JointCandidates> learn(const DataSet& data, const Job& job, Evolutions& evolutions,
                                   const CalibrateOptions& options, CalibrateResult& result) {
  if (job.method != Method::distal) return learn_directly(data, job, evolutions, options, result);
  DistalOutcome outcome = learn_distally(data, job, result.preparation, evolutions);
  result.distal = std::move(outcome.steps);
  if (job.corrections.sharing.functions > 0) result.functions = std::move(outcome.functions);
  return std::move(outcome.candidates);
}

/// Closes the loop around result.calibration.
void close_the_loop(const DataSet& data, const Job& job, Evolutions& evolutions, const std::atomic<bool>& interrupt,
                    const CalibrateOptions& options, CalibrateResult& result) {
  LoopDisplay display(stderr, data.robot, options.quiet);
  const auto watch = [&](const Round& round) {
    display.on_round(round);
    if (options.chronicle != nullptr) options.chronicle->round_ends(round, data.robot);
    return !interrupt;
  };
  AnnouncedEvolver evolver(evolutions, display);
  ClosedCalibration closed =
      close_calibration(data, job, result.preparation, result.calibration, evolver, watch, result.functions);
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
          .posterior = posterior_of(data, job.declared, calibration),
          .interval = interval_of(data, job.declared, calibration),
          .measured = measured_ranges(data, calibration),
          .data_name = data.name,
          .data_sha256 = data.sha256,
          .seed = job.seed,
          .version = DEMECAL_VERSION};
}

CalibrateResult calibrate(const DataSet& data, const Job& job,
                          const std::function<std::unique_ptr<Fleet>()>& make_fleet, const std::atomic<bool>& interrupt,
                          const CalibrateOptions& options) {
  const Clock::time_point begin = Clock::now();
  if (job.method == Method::structural) return calibrate_structurally(data, job, interrupt, options);
  CalibrateResult result;
  Evolutions evolutions(job, make_fleet, interrupt, options);
  if (evolves_on_islands(job)) evolutions.gather();
  result.preparation = prepare(data, job);
  const std::vector<JointCandidates> candidates = learn(data, job, evolutions, options, result);
  result.end = evolutions.end();
  result.fronts = evolutions.take_fronts();
  result.calibration = conclude(data, job, result.preparation, candidates);
  result.before = result.calibration.robot;
  if (result.end == RunEnd::finished && job.closed_loop.max_effects > 0) {
    close_the_loop(data, job, evolutions, interrupt, options, result);
  }
  evolutions.dismiss();
  result.model = model_of(data, job, result.calibration);
  result.model.functions = result.functions;
  result.history = evolutions.take_history();
  result.facts = evolutions.facts();
  result.facts.wall_s = std::chrono::duration<double>(Clock::now() - begin).count();
  result.facts.interrupted = result.end == RunEnd::interrupted;
  result.facts.asynchronous = options.asynchronous;
  return result;
}

}  // namespace demecal
