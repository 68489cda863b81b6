#include <algorithm>
#include <string>
#include <thread>
#include <utility>

#include "calibration/shared_functions.hpp"
#include "closed_calibration/calibrated_model.hpp"
#include "closed_calibration/closed_calibration.hpp"
#include "config/job_file.hpp"
#include "data/text.hpp"
#include "distal/learning.hpp"
#include "errors/input_error.hpp"
#include "library/conversion.hpp"
#include "library/local_evolver.hpp"

namespace demecal {
namespace {

DeclaredModel declared_model(const std::vector<std::string>& words) {
  const std::vector<std::string> known = declared_words();
  for (const std::string& word : words) {
    if (std::ranges::find(known, word) == known.end())
      throw InputError({}, word, "cannot be declared; the nearest that can is '" + nearest_name(word, known) + "'");
  }
  return declared_model(words);
}

Job to_job(const CalibrationSettings& settings) {
  Job job;
  if (!settings.job_file.empty()) job = load_job(settings.job_file);
  if (job.name.empty()) job.name = "library";
  if (!settings.declared.empty()) job.declared = declared_model(settings.declared);
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

struct Learnt {
  std::vector<JointCandidates> candidates;
  KnownFunctions functions;  ///< that joints share; nothing where the job does not ask for any
};

Learnt learn(const DataSet& data, const Job& job, const Preparation& preparation, LocalEvolver& evolver) {
  const bool shares = job.corrections.sharing.functions > 0;
  if (job.method == Method::distal) {
    DistalOutcome outcome = learn_distally(data, job, preparation, evolver);
    return {std::move(outcome.candidates), shares ? std::move(outcome.functions) : KnownFunctions{}};
  }
  if (!shares) return {evolver.evolve(preparation.training, {job.seed, job.gp.number_generations}).joints, {}};
  StagedOutcome outcome = learn_in_stages(preparation.training, job, evolver);
  return {std::move(outcome.candidates), std::move(outcome.functions)};
}

CalibratedModel calibrated_model(const DataSet& data, const Job& job, LocalEvolver& evolver) {
  evolver.say("calibrating " + std::to_string(data.poses.size()) + " poses of " + data.robot.name);
  const Preparation preparation = prepare(data, job);
  Learnt learnt = learn(data, job, preparation, evolver);
  Calibration calibration = conclude(data, job, preparation, learnt.candidates);
  if (!evolver.is_interrupted() && job.closed_loop.max_effects > 0) {
    const RoundWatcher watch = [&evolver](const Round& round) {
      if (round.verdict == Verdict::added) evolver.say(round.diagnosis);
      return !evolver.is_interrupted();
    };
    calibration = close_calibration(data, job, preparation, calibration, evolver, watch, learnt.functions).calibration;
  }
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
          .functions = std::move(learnt.functions),
          .data_name = data.name,
          .data_sha256 = data.sha256,
          .seed = job.seed,
          .version = DEMECAL_VERSION};
}

}  // namespace

CalibratedArm calibrate(const Measurements& measured, const CalibrationSettings& settings) {
  require_plausible(measured, settings);
  const DataSet& data = measured.implementation().data;
  auto arm = std::make_shared<CalibratedArm::Implementation>();
  const Job job = to_job(settings);
  const unsigned threads = settings.threads > 0 ? settings.threads : std::thread::hardware_concurrency();
  LocalEvolver evolver(job, threads, settings.progress);
  arm->model = calibrated_model(data, job, evolver);
  return CalibratedArm(std::move(arm));
}

}  // namespace demecal
