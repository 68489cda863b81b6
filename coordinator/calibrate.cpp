#include "coordinator/calibrate.hpp"

#include <optional>

#include "calibration/closed_calibration.hpp"
#include "coordinator/distal_learning.hpp"
#include "coordinator/evolutions.hpp"
#include "coordinator/loop_display.hpp"
#include "coordinator/structural_learning.hpp"

namespace demecal {
namespace {

using Clock = std::chrono::steady_clock;

std::string words_for(Sought sought, int luck) {
  if (sought == Sought::corrections) return "evolving the joint corrections anew beside the effects";
  if (sought == Sought::formulas) return "evolving formulas over all circumstances on what is left";
  return "the same search on permuted poses, to know what luck finds: number " + std::to_string(luck);
}

/// Whether the corrections are evolved by workers, and not in this process.
bool evolves_on_islands(const Job& job) {
  return job.declared.joint_corrections && (job.method != Method::distal || job.distal.form == DistalForm::parallel);
}

/// What islands or this process evolved for every joint, by the job's method; the run's end is in `evolutions`.
std::vector<JointCandidates> learn(const DataSet& data, const Job& job, Evolutions& evolutions,
                                   CalibrateResult& result) {
  const Preparation& preparation = result.preparation;
  if (job.method != Method::distal) return evolutions.run(preparation.training);
  DistalOutcome outcome = learn_distally(data, job, preparation, evolutions);
  result.distal = std::move(outcome.steps);
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
  int lucky = 0;
  const Evolve evolve = [&](const std::vector<JointTraining>& training, Sought sought) {
    display.say(words_for(sought, sought == Sought::luck ? ++lucky : 0));
    std::optional<std::vector<JointCandidates>> candidates = evolutions.run(training, sought != Sought::luck);
    if (evolutions.end() == RunEnd::no_worker) display.say("no worker is left: the loop's own corrections are kept");
    if (evolutions.end() != RunEnd::finished) candidates.reset();
    return candidates;
  };
  LearnCorrections distally = [&](const Preparation& of) -> std::optional<std::vector<JointCandidates>> {
    display.say(words_for(Sought::corrections, 0));
    DistalOutcome outcome = learn_distally(data, job, of, evolutions);
    if (evolutions.end() != RunEnd::finished) return std::nullopt;
    return std::move(outcome.candidates);
  };
  if (job.method != Method::distal) distally = nullptr;
  ClosedCalibration closed =
      close_calibration(data, job, result.preparation, result.calibration, evolve, watch, distally);
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
  if (job.method == Method::structural) return calibrate_structurally(data, job, interrupt, options);
  CalibrateResult result;
  Evolutions evolutions(job, make_fleet, interrupt, options);
  if (evolves_on_islands(job)) evolutions.gather();
  result.preparation = prepare(data, job);
  const std::vector<JointCandidates> candidates = learn(data, job, evolutions, result);
  result.end = evolutions.end();
  result.fronts = evolutions.take_fronts();
  result.calibration = conclude(data, job, result.preparation, candidates);
  result.before = result.calibration.robot;
  if (result.end == RunEnd::finished && job.closed_loop.max_effects > 0) {
    close_the_loop(data, job, evolutions, interrupt, options, result);
  }
  evolutions.dismiss();
  result.model = model_of(data, job, result.calibration);
  result.history = evolutions.take_history();
  result.facts = evolutions.facts();
  result.facts.wall_s = std::chrono::duration<double>(Clock::now() - begin).count();
  result.facts.interrupted = result.end == RunEnd::interrupted;
  result.facts.asynchronous = options.asynchronous;
  return result;
}

}  // namespace demecal
