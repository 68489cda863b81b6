#include "coordinator/chronicle.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <chrono>
#include <cmath>

#include "monitor/watched.hpp"
#include "report/make_report.hpp"

namespace demecal {
namespace {

using Stage = LoopNews::Stage;

constexpr std::chrono::milliseconds kFarewell{300};
constexpr double kShareOfNote = 0.05;  // less of a change in what a worker waited is not recorded

std::uint64_t new_calibration() {
  const auto moment = std::chrono::system_clock::now().time_since_epoch().count();
  return (static_cast<std::uint64_t>(moment) << 16) ^ static_cast<std::uint64_t>(::getpid()) ^ 1U;
}

LoopNews::Verdict verdict_of(const Round& round) {
  switch (round.verdict) {
    case Verdict::added:
      return LoopNews::Verdict::added;
    case Verdict::rejected:
      return LoopNews::Verdict::rejected;
    case Verdict::none:
      break;
  }
  return LoopNews::Verdict::none;
}

}  // namespace

Chronicle::Chronicle(const std::string& folder, bool resume, std::string job, std::unique_ptr<Transport> herald)
    : file_(folder + "/" + kEventFile, resume), herald_(std::move(herald)) {
  stage_.calibration = new_calibration();
  stage_.job = std::move(job);
  tell_stage(Stage::preparing, "fitting what is declared");
}

Chronicle::~Chronicle() {
  try {
    if (!is_over(stage_.stage)) ends(Stage::failed, "failed");
  } catch (const std::exception&) {
    // Whoever waits for it learns from its participant's end.
  }
}

void Chronicle::run_begins(const CalibrationData& data, const std::vector<Progress>& reached) {
  stage_.run = data.run;
  ++evolutions_;
  tell_stage(Stage::evolving, evolutions_ == 1 ? "evolving the joint corrections"
                                               : fmt::format("closing the loop: evolution {}", evolutions_));
  file_.note(data);
  std::map<IslandKey, Progress> last;
  for (const Progress& progress : reached) last[progress.island] = progress;
  for (const auto& [island, progress] : last) {
    file_.note(progress);
    herald_->publish(progress);
  }
}

void Chronicle::run_ends(Control::State state) {
  file_.note(Control{stage_.run, state, stage_.job});
  if (state == Control::State::finished) tell_stage(Stage::closing, "closing the loop");
}

void Chronicle::fleet_ends() {
  for (auto& [name, status] : workers_) {
    if (status.only_run == 0 || status.leaving) continue;
    status.leaving = true;  // nobody listens when it says so itself
    file_.note(status);
  }
}

void Chronicle::heard(const WorkerStatus& status) {
  const auto known = workers_.find(status.worker);
  if (known != workers_.end()) {
    WorkerStatus before = known->second;
    const double change = std::abs(status.waited_share - before.waited_share);
    before.waited_share = status.waited_share;
    if (before == status && change < kShareOfNote) return;
  }
  workers_[status.worker] = status;
  file_.note(status);
}

void Chronicle::round_ends(const Round& round, const Robot& described) {
  LoopNews news = stage_;
  news.round = static_cast<std::uint32_t>(round.number);
  news.verdict = verdict_of(round);
  if (!round.effect.kind.empty()) {
    const EffectEntry effect = effect_entry(round.effect, described);
    news.kind = effect.kind;
    news.joint = static_cast<std::uint32_t>(effect.joint.value_or(0));
    news.label = effect.name();
  }
  news.text = round.verdict == Verdict::added ? round.diagnosis : round.reason;
  news.validation_before_m = 1e-3 * round.validation_before_mm;
  news.validation_after_m = 1e-3 * round.validation_after_mm;
  tell(news);
}

void Chronicle::ends(LoopNews::Stage stage, const std::string& text) {
  tell_stage(stage, text);
  herald_->flush(kFarewell);
}

void Chronicle::tell_stage(LoopNews::Stage stage, const std::string& text) {
  stage_.stage = stage;
  stage_.text = text;
  tell(stage_);
}

void Chronicle::tell(const LoopNews& news) {
  file_.note(news);
  herald_->publish(news);
}

}  // namespace demecal
