#include "coordinator/event_log.hpp"

#include <fmt/format.h>
#include <unistd.h>
#include <algorithm>
#include <chrono>
#include <cstddef>
#include <exception>
#include <filesystem>
#include <limits>
#include <optional>
#include <set>
#include <system_error>
#include <utility>
#include <variant>

#include "effects/effect.hpp"
#include "errors/input_error.hpp"
#include "evolution/archipelago.hpp"
#include "monitor/paced_events.hpp"
#include "protocol/stages.hpp"
#include "report/figures.hpp"
#include "report/make_report.hpp"
#include "report/report.hpp"
#include "yaml/files.hpp"

namespace demecal {
namespace {

using NewsStage = LoopNews::Stage;
using EventClock = std::chrono::steady_clock;

constexpr std::chrono::milliseconds kReporterTimeout{300};

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

double metres_from_mm(const std::optional<double>& value_mm) {
  return 1e-3 * value_mm.value_or(std::numeric_limits<double>::quiet_NaN());
}

CauseFound cause_found(const CauseEntry& entry, std::uint64_t calibration, std::uint32_t number) {
  CauseFound found;
  found.calibration = calibration;
  found.number = number;
  found.cause = entry.cause;
  found.joint = static_cast<std::uint32_t>(entry.joint.value_or(0));
  found.label = entry.name;
  found.without_m = metres_from_mm(entry.without_mm);
  found.with_m = metres_from_mm(entry.with_mm);
  found.share_of_error = entry.share_of_error.value_or(std::numeric_limits<double>::quiet_NaN());
  found.advice = entry.advice;
  return found;
}

/// The figures that the calibration is judged by.
std::string finished_with(const Report& report) {
  const std::optional<Improvement> figures = improvement(error_stages(report));
  if (!figures || !figures->before.mean_mm || !figures->after.mean_mm) return "finished";
  return fmt::format("finished: mean tool error {:.3f} -> {:.3f} mm on {} poses", *figures->before.mean_mm,
                     *figures->after.mean_mm, figures->set.name);
}

/// What a file holds that is gone on with.
struct RecordedBefore {
  double end_s = 0.0;
  std::set<std::uint64_t> unended;  ///< calibrations that were broken off
};

void note_recorded(const Event& event, RecordedBefore& before) {
  before.end_s = event.time_s;
  if (const auto* lost = std::get_if<CalibrationLost>(&event.message)) before.unended.erase(lost->calibration);
  const auto* news = std::get_if<LoopNews>(&event.message);
  if (news == nullptr || news->round != 0) return;
  before.unended.insert(news->calibration);
  if (is_over(news->stage)) before.unended.erase(news->calibration);
}

/// Cuts off what follows the last whole line; a file that cannot be gone on with goes.
RecordedBefore prepare_to_resume(const std::string& path) {
  RecordedBefore before;
  try {
    const std::string text = read_file(path);
    const std::size_t end = text.rfind('\n');
    std::filesystem::resize_file(path, end == std::string::npos ? 0 : end + 1);
    for (const Event& event : read_events(path)) note_recorded(event, before);
  } catch (const std::exception&) {
    std::error_code ignored;
    std::filesystem::remove(path, ignored);
    return {};
  }
  return before;
}

}  // namespace

EventFile::EventFile(const std::string& path, bool resume) : begin_(EventClock::now()) {
  const RecordedBefore before = resume ? prepare_to_resume(path) : RecordedBefore{};
  begin_ -= std::chrono::duration_cast<EventClock::duration>(std::chrono::duration<double>(before.end_s));
  file_.open(path, resume ? std::ios::app : std::ios::trunc);
  if (before.end_s <= 0.0) file_ << first_event_line() << std::endl;
  for (const std::uint64_t calibration : before.unended) note(CalibrationLost{calibration});
}

void EventFile::note(const Message& message) {
  const std::string line = event_line(message, std::chrono::duration<double>(EventClock::now() - begin_).count());
  if (!line.empty() && file_) file_ << line << std::endl;
}

std::vector<Event> read_events(const std::string& path) {
  const std::string text = read_file(path);
  std::vector<Event> events;
  int line = 0;
  for (std::size_t begin = 0; begin < text.size();) {
    const std::size_t end = text.find('\n', begin);
    if (end == std::string::npos) break;
    ++line;
    if (auto event = read_event(text.substr(begin, end - begin), path, line)) events.push_back(std::move(*event));
    begin = end + 1;
  }
  return events;
}

EventLog::EventLog(const std::string& folder, bool resume, std::string job, std::unique_ptr<Transport> reporter)
    : file_(folder + "/" + kEventFile, resume), reporter_(std::move(reporter)) {
  stage_.calibration = new_calibration();
  stage_.job = std::move(job);
  publish_stage(NewsStage::preparing, "fitting what is declared");
}

EventLog::~EventLog() {
  try {
    if (!is_over(stage_.stage)) finish(NewsStage::failed, "failed");
  } catch (const std::exception&) {
    // Whoever waits for it learns from its participant's end.
  }
}

void EventLog::on_run_begins(const CalibrationData& data, const std::vector<Progress>& reached, bool /*shown*/) {
  stage_.run = data.run;
  of_sets_ = data.breeds == Breeds::sets;
  if (of_sets_) {
    publish_stage(NewsStage::evolving, "closing the loop: evolving explanations");
  } else {
    ++evolutions_;
    publish_stage(NewsStage::evolving, evolutions_ == 1 ? "evolving the joint corrections"
                                                        : fmt::format("closing the loop: evolution {}", evolutions_));
  }
  file_.note(data);
  reached_.clear();
  for (const Progress& progress : reached) reached_[progress.island] = progress;
  for (const auto& [island, progress] : reached_) {
    file_.note(progress);
    reporter_->publish(progress);
  }
}

void EventLog::on_progress(const Progress& progress) {
  file_.note(progress);
  reached_[progress.island] = progress;
}

void EventLog::on_run_ends(RunEnd end) {
  const auto state = end == RunEnd::finished ? Control::State::finished : Control::State::cancelled;
  file_.note(Control{stage_.run, state, stage_.job});
  for (const auto& [island, progress] : reached_) reporter_->publish(progress);
  const bool goes_on = end == RunEnd::finished || (of_sets_ && end == RunEnd::no_worker);
  if (goes_on) publish_stage(NewsStage::closing, "closing the loop");
}

void EventLog::on_workers_end() {
  for (auto& [name, status] : workers_) {
    if (status.only_run == 0 || status.leaving) continue;
    status.leaving = true;  // nobody listens when it says so itself
    file_.note(status);
  }
}

void EventLog::on_worker(const WorkerStatus& status) {
  const auto known = workers_.find(status.worker);
  if (known != workers_.end() && !is_news(status, known->second)) return;
  workers_[status.worker] = status;
  file_.note(status);
}

void EventLog::on_round(const Round& round, const Robot& described) {
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
  rounds_[news.round] = news;
  publish(news);
}

void EventLog::tell_of_rounds(const Report& report) {
  for (const RoundEntry& round : report.rounds) {
    const auto told = rounds_.find(static_cast<std::uint32_t>(round.round));
    if (told == rounds_.end() || !round.added() || told->second.label != round.effect.name()) continue;
    LoopNews& news = told->second;
    if (news.verdict == LoopNews::Verdict::added && news.text == round.diagnosis) continue;
    news.stage = stage_.stage;
    news.verdict = LoopNews::Verdict::added;
    news.text = round.diagnosis;
    publish(news);
  }
}

void EventLog::tell_of(const Report& report) {
  tell_of_rounds(report);
  for (std::size_t i = 0; i < report.causes.size(); ++i) {
    publish(cause_found(report.causes[i], stage_.calibration, static_cast<std::uint32_t>(i + 1)));
  }
  FinalFigures figures;
  figures.calibration = stage_.calibration;
  figures.job = stage_.job;
  figures.causes = static_cast<std::uint32_t>(report.causes.size());
  figures.effects = static_cast<std::uint32_t>(std::ranges::count_if(report.rounds, &RoundEntry::added));
  figures.validation_before_m = metres_from_mm(report.before.validation.rms_mm);
  figures.validation_after_m = metres_from_mm(report.after.validation.rms_mm);
  figures.accept_before_m = metres_from_mm(report.before.accept.rms_mm);
  figures.accept_after_m = metres_from_mm(report.after.accept.rms_mm);
  publish(figures);
}

void EventLog::finish(const Report& report, bool interrupted) {
  tell_of(report);
  finish(interrupted ? NewsStage::interrupted : NewsStage::finished,
         interrupted ? "interrupted" : finished_with(report));
}

void EventLog::finish(LoopNews::Stage stage, const std::string& text) {
  publish_stage(stage, text);
  reporter_->flush(kReporterTimeout);
}

void EventLog::publish_stage(LoopNews::Stage stage, const std::string& text) {
  stage_.stage = stage;
  stage_.text = text;
  publish(stage_);
}

void EventLog::publish(const Message& message) {
  file_.note(message);
  reporter_->publish(message);
}

}  // namespace demecal
