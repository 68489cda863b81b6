#include <algorithm>
#include <atomic>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <ranges>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "calibration/job.hpp"
#include "closed_calibration/calibrated_model.hpp"
#include "config/job_file.hpp"
#include "config/model_file.hpp"
#include "data/data_set.hpp"
#include "data/text.hpp"
#include "diagnosis/outcome.hpp"
#include "errors/input_error.hpp"
#include "library/conversion.hpp"
#include "library/demecal.hpp"
#include "parameters/declared_model.hpp"
#include "parameters/posterior.hpp"
#include "pieces/pieces.hpp"
#include "prediction/corrected_robot.hpp"
#include "report/evaluation.hpp"
#include "scheduling/worker_pool.hpp"
#include "workflows/piece_threads.hpp"
#include "workflows/workflows.hpp"

namespace demecal::inline library {
namespace {

DeclaredModel declared_model(const std::vector<std::string>& words) {
  const std::vector<std::string> known = declared_words();
  for (const std::string& word : words) {
    if (std::ranges::find(known, word) == known.end())
      throw InputError({}, word, "cannot be declared; the nearest that can is '" + nearest_name(word, known) + "'");
  }
  return config::declared_model(words);
}

Job to_job(const CalibrationSettings& settings) {
  Job job;
  if (!settings.job_file.empty()) job = load_job(settings.job_file);
  if (job.name.empty()) job.name = "library";
  if (!settings.declared.empty()) job.declared = declared_model(settings.declared);
  if (settings.seed) job.seed = *settings.seed;
  if (settings.max_effects) job.closed_loop.max_effects = *settings.max_effects;
  return job;
}

void require_plausible(const Measurements& measured, const CalibrationSettings& settings) {
  if (settings.force || !measured.contradict_arm()) return;
  std::string sentences;
  for (const std::string& finding : measured.findings()) sentences += "\n- " + finding;
  throw InputError({measured.implementation().data.file, 0}, "",
                   "the measurements and the arm contradict each other:" + sentences);
}

/// Passes on in sentences what happens, and asks for an end where that is the answer.
class ProgressReporter final : public CalibrationObserver {
 public:
  explicit ProgressReporter(const std::function<bool(const std::string&)>& progress) : progress_(progress) {}

  void on_round(const Round& round, const Robot&) override {
    if (round.verdict == Verdict::added) on_message(round.diagnosis);
  }
  void on_message(const std::string& text) override {
    if (progress_ && !progress_(text)) interrupt_ = true;
  }
  const std::atomic<bool>& interrupt() const { return interrupt_; }

 private:
  const std::function<bool(const std::string&)>& progress_;
  std::atomic<bool> interrupt_{false};
};

}  // namespace

CalibratedArm calibrate(const Measurements& measured, const CalibrationSettings& settings) {
  require_plausible(measured, settings);
  const DataSet& data = measured.implementation().data;
  const unsigned threads = settings.threads > 0 ? settings.threads : std::max(std::thread::hardware_concurrency(), 1U);
  ProgressReporter reporter(settings.progress);
  reporter.on_message("calibrating " + std::to_string(data.poses.size()) + " poses of " + data.robot.name);
  PieceThreads pieces(threads);
  const RunPiecesBy by_threads(pieces);
  CalibrateOptions options;
  options.observer = &reporter;
  const MakeWorkerPool make_pool = [threads] { return std::make_unique<InProcessWorkerPool>(threads); };
  CalibrateResult result = calibrate(data, to_job(settings), make_pool, reporter.interrupt(), options);
  auto arm = std::make_shared<CalibratedArm::Implementation>();
  arm->model = std::move(result.model);
  arm->model.data_findings = measured.implementation().check.kinds();
  arm->model.of_one_contact = touches_one_contact_alone(data);
  arm->text = model_text(arm->model);
  CalibratedModel written = read_model(arm->text, "model.yaml");  // whose numbers have fewer digits here and there
  arm->model.robot = std::move(written.robot);
  arm->model.posterior = std::move(written.posterior);
  return CalibratedArm(std::move(arm));
}

}  // namespace demecal::inline library
