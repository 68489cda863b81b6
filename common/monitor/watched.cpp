#include "monitor/watched.hpp"

#include <algorithm>
#include <functional>
#include <iterator>
#include <ranges>
#include <set>
#include <type_traits>
#include <utility>
#include <variant>

#include "effect_sets/set_training.hpp"
#include "fitness/fitness.hpp"
#include "fitness/parameters.hpp"
#include "protocol/faults.hpp"

namespace demecal::inline monitor {
namespace {

constexpr std::size_t kMostKept = 8;  // runs, and calibrations
constexpr std::size_t kMostRounds = 1000, kMostEfforts = 1000;
constexpr std::size_t kMostCausesKept = 1000;
constexpr std::size_t kMostWorkers = 4096;
constexpr std::size_t kMostHappenings = 8;

bool is_believable(const CalibrationData& data) {
  const Archipelago& islands = data.archipelago;
  return data.run != 0 && !islands.joints.empty() && islands.joints.size() <= kMostJoints &&
         std::ranges::is_sorted(islands.joints) && islands.joints.back() < kMostJoints && islands.demes_per_joint > 0 &&
         islands.demes_per_joint <= kMostDemes && data.parameters.number_generations > 0;
}

bool has_island(const CalibrationData& data, IslandKey island) {
  const auto& joints = data.archipelago.joints;
  return std::ranges::binary_search(joints, island.joint) && island.deme < data.archipelago.demes_per_joint;
}

void mark_evaluations(WatchedRun& run, double now_s) {
  constexpr double kAtOnce_s = 0.5, kApart_s = 1.0;
  constexpr std::size_t kMostMarks = 11;
  if (run.marks.empty() ? now_s - run.seen_s < kAtOnce_s : now_s - run.marks.back().time_s < kApart_s) return;
  run.marks.push_back({now_s, run.evaluations});
  if (run.marks.size() > kMostMarks) run.marks.pop_front();
}

/// Drops those that appeared first.
template <class Entries>
void keep_latest(Entries& entries, std::size_t most) {
  while (entries.size() > most) {
    entries.erase(std::ranges::min_element(entries, {}, [](const auto& entry) { return entry.second.order; }));
  }
}

template <class Entries>
auto latest(const Entries& entries) {
  return std::ranges::max_element(entries, {}, [](const auto& entry) { return entry.second.order; });
}

}  // namespace

bool WatchedRun::has_finished(const Progress& island) const {
  return has_data() && island.generation >= static_cast<std::uint32_t>(data.parameters.number_generations);
}

void Watched::take(const Message& message, double now_s) {
  std::visit(
      [&](const auto& plain) {
        using Plain = std::decay_t<decltype(plain)>;
        constexpr bool concerns_people = !std::is_same_v<Plain, IslandTask> && !std::is_same_v<Plain, Migrants> &&
                                         !std::is_same_v<Plain, Checkpoint> && !std::is_same_v<Plain, Outcome>;
        if constexpr (concerns_people) note(plain, now_s);
      },
      message);
}

void Watched::note(const CalibrationData& data, double now_s) {
  if (!is_believable(data)) return;
  WatchedRun& run = run_of(data.run, now_s);
  if (run.has_data()) return;
  run.data = {data.run, data.job, data.seed, data.parameters, data.archipelago, {}, data.breeds, {}, {}};
  std::erase_if(run.islands, [&](const auto& island) { return !has_island(data, island.first); });
  run.evaluations = 0;
  for (const auto& [key, island] : run.islands) run.evaluations += island.evaluations;
  note_effort(run, data.run);
}

void Watched::note(const Progress& progress, double now_s) {
  if (progress.run == 0 || progress.island.joint >= kMostJoints || progress.island.deme >= kMostDemes) return;
  WatchedRun& run = run_of(progress.run, now_s);
  if (run.has_data() && !has_island(run.data, progress.island)) return;
  Progress& last = run.islands[progress.island];
  if (progress.epoch < last.epoch) return;
  run.evaluations += progress.evaluations - last.evaluations;
  last = progress;
  mark_evaluations(run, now_s);
  note_effort(run, progress.run);
}

void Watched::note_effort(const WatchedRun& run, RunId id) {
  Effort& effort = efforts_[id];
  const bool of_sets = run.has_data() && run.data.breeds == Breeds::sets;
  effort = {of_sets ? 0 : run.evaluations, of_sets ? run.evaluations : 0, 0};
  for (const auto& [key, island] : run.islands) effort.migrants += island.migrants_taken;
  if (efforts_.size() > kMostEfforts)
    efforts_.erase(efforts_.begin()->first == id ? std::next(efforts_.begin()) : efforts_.begin());
}

void Watched::note(const Control& control, double) {
  const auto run = runs_.find(control.run);
  if (run != runs_.end()) run->second.state = control.state;
}

void Watched::note(const WorkerStatus& status, double now_s) {
  if (find_fault(status)) return;
  const bool is_known = workers_.contains(status.worker);
  if (!is_known && (status.leaving || workers_.size() >= kMostWorkers)) return;
  WatchedWorker& worker = workers_[status.worker];
  const auto before = worker.presence;
  if (!is_known) worker.order = ++order_;
  worker.status = status;
  worker.presence = status.leaving ? WatchedWorker::Presence::left : WatchedWorker::Presence::here;
  if (status.leaving) {
    worker.gone_s = now_s;
  } else if (!is_known || before != WatchedWorker::Presence::here) {
    add_notice(now_s, "worker " + status.worker + (is_known ? " is back" : " joined"));
  }
}

void Watched::note(const WorkerLost& lost, double now_s) {
  const auto worker = workers_.find(lost.worker);
  if (worker == workers_.end() || worker->second.presence != WatchedWorker::Presence::here) return;
  worker->second.presence = WatchedWorker::Presence::lost;
  worker->second.gone_s = now_s;
  add_notice(now_s, "worker " + lost.worker + " is lost");
}

void Watched::note(const LoopNews& news, double now_s) {
  if (news.calibration == 0) return;
  WatchedCalibration& calibration = calibration_of(news.calibration, now_s);
  calibration.lost = false;
  if (news.round > 0) {
    if (calibration.rounds.size() < kMostRounds) calibration.rounds[news.round] = news;
    return;
  }
  calibration.stage = news;
  const auto& runs = calibration.runs;
  if (news.run != 0 && std::ranges::find(runs, news.run) == runs.end() && runs.size() < kMostRounds) {
    calibration.runs.push_back(news.run);
  }
}

void Watched::note(const CauseFound& cause, double now_s) {
  if (cause.calibration == 0 || cause.number == 0) return;
  auto& causes = calibration_of(cause.calibration, now_s).causes;
  if (causes.size() < kMostCausesKept || causes.contains(cause.number)) causes[cause.number] = cause;
}

void Watched::note(const FinalFigures& figures, double now_s) {
  if (figures.calibration != 0) calibration_of(figures.calibration, now_s).figures = figures;
}

void Watched::note(const CalibrationLost& lost, double now_s) {
  const auto calibration = calibrations_.find(lost.calibration);
  if (calibration == calibrations_.end() || !calibration->second.is_live()) return;
  calibration->second.lost = true;
  add_notice(now_s, "the coordinator of " + calibration->second.stage.job + " is gone");
}

WatchedRun& Watched::run_of(RunId run, double now_s) {
  const auto [found, is_new] = runs_.try_emplace(run);
  if (is_new) {
    found->second.order = ++order_;
    found->second.seen_s = now_s;
    keep_latest(runs_, kMostKept);
    std::erase_if(workers_, [](const auto& worker) { return worker.second.presence != WatchedWorker::Presence::here; });
  }
  return runs_.at(run);
}

WatchedCalibration& Watched::calibration_of(std::uint64_t calibration, double now_s) {
  const auto [found, is_new] = calibrations_.try_emplace(calibration);
  if (is_new) {
    found->second.order = ++order_;
    found->second.seen_s = now_s;
    keep_latest(calibrations_, kMostKept);
  }
  return calibrations_.at(calibration);
}

void Watched::add_notice(double now_s, std::string text) {
  notices_.push_back({now_s, std::move(text)});
  if (notices_.size() > kMostHappenings) notices_.pop_front();
}

const WatchedCalibration* Watched::calibration() const {
  const WatchedCalibration* shown = nullptr;
  for (const auto& [number, calibration] : calibrations_) {
    const bool is_better = shown == nullptr || (calibration.is_live() && !shown->is_live()) ||
                           (calibration.is_live() == shown->is_live() && calibration.order > shown->order);
    if (is_better) shown = &calibration;
  }
  return shown;
}

const WatchedRun* Watched::run() const {
  if (const WatchedCalibration* shown = calibration()) {
    const auto run = runs_.find(shown->stage.run);
    return run == runs_.end() ? nullptr : &run->second;
  }
  return runs_.empty() ? nullptr : &latest(runs_)->second;
}

Effort Watched::effort() const {
  Effort all;
  const auto add = [&](RunId run) {
    const auto found = efforts_.find(run);
    if (found == efforts_.end()) return;
    all.evaluations += found->second.evaluations;
    all.sets += found->second.sets;
    all.migrants += found->second.migrants;
  };
  if (const WatchedCalibration* shown = calibration()) {
    for (const RunId run : shown->runs) add(run);
  } else if (!runs_.empty()) {
    add(latest(runs_)->first);
  }
  return all;
}

std::size_t Watched::other_calibrations() const {
  const WatchedCalibration* shown = calibration();
  return static_cast<std::size_t>(std::ranges::count_if(
      calibrations_, [&](const auto& entry) { return &entry.second != shown && entry.second.is_live(); }));
}

std::vector<const WatchedWorker*> Watched::workers() const {
  const WatchedRun* shown = run();
  std::set<std::string> of_run;
  if (shown != nullptr) {
    for (const auto& [key, island] : shown->islands) of_run.insert(island.worker);
  }
  std::vector<const WatchedWorker*> chosen;
  for (const auto& [name, worker] : workers_) {
    const bool was_lost =
        worker.presence == WatchedWorker::Presence::lost && shown != nullptr && worker.gone_s >= shown->seen_s;
    if (worker.presence == WatchedWorker::Presence::here || was_lost || of_run.contains(name)) {
      chosen.push_back(&worker);
    }
  }
  std::ranges::sort(chosen, {}, &WatchedWorker::order);
  return chosen;
}

const WatchedWorker* Watched::worker(const std::string& name) const {
  const auto worker = workers_.find(name);
  return worker == workers_.end() ? nullptr : &worker->second;
}

}  // namespace demecal::inline monitor
