#include "terminal/page_tables.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "monitor/events.hpp"
#include "monitor/watched.hpp"
#include "terminal/text.hpp"

namespace demecal {
namespace {

using Lines = std::vector<std::string>;

/// Keeps the heading and the last rows, and says how many are missing.
Lines shortened(Lines lines, const TableOptions& options) {
  if (options.rows == 0 || lines.size() <= options.rows + 1) return lines;
  const std::size_t missing = lines.size() - 1 - options.rows;
  lines.erase(lines.begin() + 1, lines.begin() + 1 + static_cast<std::ptrdiff_t>(missing));
  lines.front() += painted(fmt::format("  ({} more)", missing), Ink::faint, options.colours);
  return lines;
}

std::string presence_of(const WatchedWorker& worker) {
  switch (worker.presence) {
    case WatchedWorker::Presence::left:
      return "left";
    case WatchedWorker::Presence::lost:
      return "lost";
    case WatchedWorker::Presence::here:
      break;
  }
  return percent(worker.status.waited_share);
}

/// How many islands of the run the worker was the last to tell of.
std::ptrdiff_t islands_of(const WatchedWorker& worker, const WatchedRun* run) {
  if (run == nullptr) return 0;
  return std::ranges::count_if(run->islands,
                               [&](const auto& island) { return island.second.worker == worker.status.worker; });
}

/// The cells of a worker's line, as texts.
struct WorkerCells {
  std::string tag, host, process, slots, islands, speed, waited;
};

std::string worker_line(const WorkerCells& cells, std::size_t columns) {
  constexpr std::size_t kTag = 5, kProcess = 10, kFigureRoom = 31, kFewestForProcess = 64;
  const std::size_t process_room = columns < kFewestForProcess ? 0 : kProcess;
  const std::size_t host_room = std::min<std::size_t>(columns - kTag - process_room - kFigureRoom, 40);
  return left(cells.tag, kTag) + left(cells.host, host_room) +
         (process_room == 0 ? "" : right(cells.process, process_room)) + right(cells.slots, 7) +
         right(cells.islands, 9) + right(cells.speed, 8) + right(cells.waited, 7);
}

std::string in_mm(double value_m) {
  return std::isfinite(value_m) ? fmt::format("{:.3f}", 1e3 * value_m) : "–";
}

std::string round_line(const LoopNews& round, std::size_t columns) {
  const bool is_added = round.verdict == LoopNews::Verdict::added;
  const std::string figures =
      is_added ? in_mm(round.validation_before_m) + " -> " + in_mm(round.validation_after_m) : to_string(round.verdict);
  const std::string label = round.label.empty() ? "nothing" : round.label;
  const std::size_t room = columns - 5 - 20;
  const std::size_t label_room = std::min<std::size_t>(room, 42);
  std::string line = right(std::to_string(round.round), 3) + "  " + left(label, label_room) + right(figures, 20);
  if (columns > columns_of(line) + 20 && !round.text.empty()) {
    line += "  " + cut(round.text, columns - columns_of(line) - 2);
  }
  return line;
}

}  // namespace

std::vector<std::string> worker_lines(const Watched& watched, double now_s, const TableOptions& options) {
  const auto workers = watched.workers();
  if (workers.empty()) return {};
  const WorkerCells heading{"", "worker's host", "process", "slots", "islands", "eval/s", "wait"};
  Lines lines{painted(worker_line(heading, options.columns), Ink::faint, options.colours)};
  for (std::size_t i = 0; i < workers.size(); ++i) {
    const WatchedWorker& worker = *workers[i];
    const WorkerStatus& status = worker.status;
    const WatchedRun* run = watched.run();
    const bool is_here = worker.presence == WatchedWorker::Presence::here;
    const double speed = run != nullptr && is_here ? evaluations_per_s(watched, *run, worker, now_s) : 0.0;
    const std::string line = worker_line(
        {fmt::format("w{}", i + 1), status.host, std::to_string(status.process), std::to_string(status.slots),
         std::to_string(islands_of(worker, run)), speed > 0.0 ? short_count(speed) : "–", presence_of(worker)},
        options.columns);
    const Ink ink = is_here ? Ink::plain : worker.presence == WatchedWorker::Presence::lost ? Ink::bad : Ink::faint;
    lines.push_back(painted(line, ink, options.colours));
  }
  return shortened(std::move(lines), options);
}

std::vector<std::string> round_lines(const WatchedCalibration* calibration, const TableOptions& options) {
  if (calibration == nullptr || calibration->rounds.empty()) return {};
  const auto added = std::ranges::count_if(
      calibration->rounds, [](const auto& round) { return round.second.verdict == LoopNews::Verdict::added; });
  const std::string heading =
      fmt::format("{} effect{} found; mean error on validation poses, mm", added, added == 1 ? "" : "s");
  Lines lines{painted(cut(heading, options.columns), Ink::faint, options.colours)};
  for (const auto& [number, round] : calibration->rounds) {
    const Ink ink = round.verdict == LoopNews::Verdict::added ? Ink::good : Ink::faint;
    lines.push_back(painted(round_line(round, options.columns), ink, options.colours));
  }
  return shortened(std::move(lines), options);
}

std::vector<std::string> happening_lines(const Watched& watched, double now_s, const TableOptions& options) {
  const auto& happenings = watched.notices();
  if (happenings.empty()) return {};
  const std::size_t count = happenings.size();
  Lines lines;
  for (std::size_t i = options.rows != 0 && count > options.rows ? count - options.rows : 0; i < count; ++i) {
    const std::string text = short_time(now_s - happenings[i].time_s) + " ago: " + happenings[i].text;
    lines.push_back(painted(cut(text, options.columns), Ink::faint, options.colours));
  }
  return lines;
}

}  // namespace demecal
