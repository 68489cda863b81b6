#include "monitor/paced_events.hpp"

#include <cmath>
#include <cstddef>
#include <nlohmann/json.hpp>
#include <variant>

#include "monitor/events.hpp"
#include "monitor/state_json.hpp"
#include "report/json.hpp"

namespace demecal::inline monitor {
namespace {

constexpr double kFigures_s = 1.0;
constexpr std::size_t kMostPaced = 20000;

std::string island_key(const Progress& progress) {
  return "progress " + std::to_string(progress.run) + ' ' + std::to_string(progress.island.joint) + ' ' +
         std::to_string(progress.island.deme);
}

}  // namespace

bool is_news(const WorkerStatus& status, const WorkerStatus& before) {
  constexpr double kShareOfNote = 0.05;
  WorkerStatus waited = before;
  waited.waited_share = status.waited_share;
  return !(waited == status) || std::abs(status.waited_share - before.waited_share) >= kShareOfNote;
}

std::vector<PacedLine> PacedEvents::take(const Message& message, double now_s) {
  watched_.take(message, now_s);
  std::vector<PacedLine> lines;
  if (const auto* progress = std::get_if<Progress>(&message)) {
    take_progress(*progress, now_s, lines);
    return lines;
  }
  const auto* status = std::get_if<WorkerStatus>(&message);
  if (status != nullptr && is_repeated(*status)) return lines;
  const std::string line = event_line(message, now_s);
  if (line.empty()) return lines;
  if (std::holds_alternative<Control>(message) || std::holds_alternative<LoopNews>(message)) {
    for (auto& [island, paced] : islands_) emit(paced, now_s, lines);
  }
  lines.push_back({line, status == nullptr ? "" : "worker " + status->worker});
  return lines;
}

std::vector<PacedLine> PacedEvents::due(double now_s) {
  std::vector<PacedLine> lines;
  for (auto& [island, paced] : islands_) {
    if (now_s - paced.told_s >= interval_s_) emit(paced, now_s, lines);
  }
  if (now_s - figures_told_s_ >= kFigures_s) emit_figures(now_s, lines);
  return lines;
}

void PacedEvents::take_progress(const Progress& progress, double now_s, std::vector<PacedLine>& lines) {
  const auto [found, is_first] = islands_.try_emplace({progress.run, progress.island});
  Paced& paced = found->second;
  if (!is_first && progress.epoch < paced.latest.epoch) return;
  paced.latest = progress;
  paced.latest.before.clear();
  paced.is_new = true;
  if (is_first || now_s - paced.told_s >= interval_s_) emit(paced, now_s, lines);
  if (islands_.size() > kMostPaced) islands_.erase(islands_.begin());
}

bool PacedEvents::is_repeated(const WorkerStatus& status) {
  const auto known = workers_.find(status.worker);
  if (known == workers_.end() && workers_.size() > kMostPaced) workers_.clear();
  if (known != workers_.end() && !is_news(status, known->second)) return true;
  workers_[status.worker] = status;
  return false;
}

void PacedEvents::emit(Paced& paced, double now_s, std::vector<PacedLine>& lines) const {
  if (!paced.is_new) return;
  paced.is_new = false;
  paced.told_s = now_s;
  lines.push_back({event_line(paced.latest, now_s), island_key(paced.latest)});
}

void PacedEvents::emit_figures(double now_s, std::vector<PacedLine>& lines) {
  const WatchedRun* run = watched_.run();
  if (run == nullptr || !run->has_data()) return;
  figures_told_s_ = now_s;
  const nlohmann::ordered_json figures = run_figures(watched_, *run, now_s);
  std::string text = one_line(figures);
  if (text == figures_) return;
  nlohmann::ordered_json json{{"event", "figures"}, {"t_s", now_s}, {"run", std::to_string(run->data.run)}};
  json.update(figures);
  figures_ = std::move(text);
  lines.push_back({one_line(json), "figures " + std::to_string(run->data.run)});
}

}  // namespace demecal::inline monitor
