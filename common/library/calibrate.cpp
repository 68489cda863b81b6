#include <algorithm>
#include <optional>
#include <thread>
#include <utility>

#include "calibration/closed_calibration.hpp"
#include "calibration/distal_rounds.hpp"
#include "calibration/distal_sequence.hpp"
#include "calibration/function_stages.hpp"
#include "calibration/model_posterior.hpp"
#include "calibration/prediction_scores.hpp"
#include "config/load_job.hpp"
#include "config/read_declared.hpp"
#include "errors/input_error.hpp"
#include "library/conversion.hpp"
#include "library/local_islands.hpp"

namespace demecal {
namespace {

Job to_job(const CalibrationSettings& settings) {
  Job job;
  if (!settings.job_file.empty()) job = load_job(settings.job_file);
  if (job.name.empty()) job.name = "library";
  if (!settings.declared.empty()) job.declared = declared_of(settings.declared);
  if (settings.seed) job.seed = *settings.seed;
  if (settings.max_effects) job.closed_loop.max_effects = *settings.max_effects;
  if (job.method == Method::structural) {
    throw InputError({settings.job_file.string(), 0}, "structural",
                     "is a method that the program alone has: `demecal calibrate`");
  }
  return job;
}

void require_plausible(const Measurements& measured, const CalibrationSettings& settings) {
  if (settings.force || !measured.contradict_arm()) return;
  std::string sentences;
  for (const std::string& finding : measured.findings()) sentences += "\n- " + finding;
  throw InputError({measured.implementation().data.file, 0}, "",
                   "the measurements and the arm contradict each other:" + sentences);
}

/// One calibration: what it evolves, and whether it may go on.
class LocalCalibration {
 public:
  LocalCalibration(const DataSet& data, const CalibrationSettings& settings)
      : data_(data),
        job_(to_job(settings)),
        threads_(settings.threads > 0 ? settings.threads : std::max(std::thread::hardware_concurrency(), 1U)),
        progress_(settings.progress) {}

  CalibratedModel run() {
    say("fitting what is declared");
    const Preparation preparation = prepare(data_, job_);
    say("evolving joint corrections");
    Calibration calibration = conclude(data_, job_, preparation, learn(preparation));
    if (go_on_ && job_.closed_loop.max_effects > 0) calibration = closed(preparation, calibration);
    return {.job = job_.name,
            .nominal = data_.robot,
            .method = job_.method,
            .declared = job_.declared,
            .robot = calibration.robot,
            .estimates = calibration.estimates,
            .joints = calibration.joints,
            .posterior = posterior_of(data_, job_.declared, calibration),
            .interval = interval_of(data_, job_.declared, calibration),
            .measured = measured_ranges(data_, calibration),
            .functions = functions_,
            .data_name = data_.name,
            .data_sha256 = data_.sha256,
            .seed = job_.seed,
            .version = DEMECAL_VERSION};
  }

 private:
  using Candidates = std::vector<JointCandidates>;

  void say(const std::string& sentence) {
    if (progress_ && !progress_(sentence)) go_on_ = false;
  }

  Candidates evolve(const std::vector<JointTraining>& trainings, const RoundTerms& terms) const {
    return evolve_locally(job_, trainings, terms, threads_);
  }

  RoundTerms whole_terms() const { return {job_.seed, job_.gp.number_generations}; }

  Candidates learn(const Preparation& preparation) {
    const bool shares = job_.corrections.sharing.functions > 0;
    if (job_.method == Method::distal) {
      DistalOutcome outcome = learn_distally(preparation, std::nullopt);
      if (shares) functions_ = std::move(outcome.functions);
      return std::move(outcome.candidates);
    }
    if (!shares) return evolve(preparation.training, whole_terms());
    const auto stage = [this](const std::vector<JointTraining>& trainings, const RoundTerms& terms) {
      return evolve(trainings, terms);
    };
    StagedOutcome outcome = learn_in_stages(preparation.training, job_, stage, [this] { return go_on_; });
    functions_ = std::move(outcome.functions);
    return std::move(outcome.candidates);
  }

  DistalOutcome learn_distally(const Preparation& preparation, const KnownFunctions& known) const {
    const DistalIndex index(data_, preparation.targets.poses, preparation.declared);
    if (job_.distal.form == DistalForm::sequential)
      return learn_in_sequence(index, preparation, job_, [this] { return go_on_; }).learnt;
    const EvolveRound round = [this](const std::vector<JointTraining>& trainings, const RoundTerms& terms) {
      return std::optional(evolve(trainings, terms));
    };
    return learn_in_rounds(index, preparation, job_, round, known);
  }

  Calibration closed(const Preparation& preparation, const Calibration& first) {
    const Evolve again = [this](const std::vector<JointTraining>& trainings, Sought sought) {
      RoundTerms terms = whole_terms();
      if (sought == Sought::corrections && functions_) terms.functions = *functions_;
      return go_on_ ? std::optional(evolve(trainings, terms)) : std::nullopt;
    };
    LearnCorrections distally = nullptr;
    if (job_.method == Method::distal) {
      distally = [this](const Preparation& anew) { return std::optional(learn_distally(anew, functions_).candidates); };
    }
    const RoundWatcher watch = [this](const Round& round) {
      if (round.verdict == Verdict::added) say(round.diagnosis);
      return go_on_;
    };
    return close_calibration(data_, job_, preparation, first, again, watch, distally).calibration;
  }

  const DataSet& data_;
  const Job job_;
  const unsigned threads_;
  std::function<bool(const std::string&)> progress_;
  KnownFunctions functions_;
  bool go_on_ = true;
};

}  // namespace

CalibratedArm calibrate(const Measurements& measured, const CalibrationSettings& settings) {
  require_plausible(measured, settings);
  const DataSet& data = measured.implementation().data;
  auto arm = std::make_shared<CalibratedArm::Implementation>();
  arm->model = LocalCalibration(data, settings).run();
  return CalibratedArm(std::move(arm));
}

}  // namespace demecal
