#include "terminal/monitor_page.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <map>
#include <optional>
#include <utility>

#include "fitness/parameters.hpp"
#include "monitor/events.hpp"
#include "monitor/watched.hpp"
#include "protocol/messages.hpp"
#include "terminal/text.hpp"

namespace demecal::inline terminal {
namespace {

using TableLines = std::vector<std::string>;

/// Keeps the heading and the last rows, and says how many are missing.
TableLines with_last_rows(TableLines lines, const TableOptions& options) {
  if (options.rows == 0 || lines.size() <= options.rows + 1) return lines;
  const std::size_t missing = lines.size() - 1 - options.rows;
  lines.erase(lines.begin() + 1, lines.begin() + 1 + static_cast<std::ptrdiff_t>(missing));
  lines.front() += styled(fmt::format("  ({} more)", missing), TextStyle::faint, options.colours);
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
  return left_aligned(cells.tag, kTag) + left_aligned(cells.host, host_room) +
         (process_room == 0 ? "" : right_aligned(cells.process, process_room)) + right_aligned(cells.slots, 7) +
         right_aligned(cells.islands, 9) + right_aligned(cells.speed, 8) + right_aligned(cells.waited, 7);
}

std::string metres_in_mm(double value_m) {
  return std::isfinite(value_m) ? fmt::format("{:.3f}", 1e3 * value_m) : "–";
}

/// Of a table whose lines are numbered: what the line is of, its figures and, where there is room, a sentence.
struct NumberedCells {
  std::uint32_t number = 0;
  std::string label, figures, text;
};

TableLines indented(const std::string& first, const std::string& text, std::size_t columns) {
  const std::size_t indent = first.size();
  TableLines lines = wrapped_lines(text, columns - indent, 0);
  for (std::size_t i = 0; i < lines.size(); ++i) lines[i] = (i == 0 ? first : std::string(indent, ' ')) + lines[i];
  return lines;
}

/// The line and, where texts are wrapped, as many more as its text takes.
TableLines numbered_lines(const NumberedCells& cells, const TableOptions& options) {
  constexpr std::size_t kNumber = 5, kFigureColumns = 20, kMostLabel = 42, kFewestText = 20;
  const std::size_t columns = options.columns, label_room = std::min(columns - kNumber - kFigureColumns, kMostLabel);
  const std::string number = right_aligned(std::to_string(cells.number), 3) + "  ";
  TableLines lines;
  if (options.wraps && display_width(cells.label) > label_room) {
    lines = indented(number, cells.label + "  " + cells.figures, columns);
  } else {
    lines = {number + left_aligned(cells.label, label_room) + right_aligned(cells.figures, kFigureColumns)};
  }
  if (options.wraps) {
    for (const std::string& line : indented(std::string(kNumber, ' '), cells.text, columns)) lines.push_back(line);
  } else if (columns > display_width(lines.front()) + kFewestText && !cells.text.empty()) {
    lines.front() += "  " + truncated(cells.text, columns - display_width(lines.front()) - 2);
  }
  return lines;
}

std::string from_to_in_mm(double from_m, double to_m) {
  return metres_in_mm(from_m) + " -> " + metres_in_mm(to_m);
}

std::string verdict_words(LoopNews::Verdict verdict) {
  return verdict == LoopNews::Verdict::none ? "not significant" : to_string(verdict);
}

TableLines round_row_lines(const LoopNews& round, const TableOptions& options) {
  const bool is_added = round.verdict == LoopNews::Verdict::added;
  return numbered_lines(
      {round.round, round.label.empty() ? "nothing" : round.label,
       is_added ? from_to_in_mm(round.validation_before_m, round.validation_after_m) : verdict_words(round.verdict),
       round.text},
      options);
}

/// Faint and, where texts are wrapped, whole.
TableLines faint_lines(const std::string& text, const TableOptions& options) {
  TableLines lines =
      options.wraps ? wrapped_lines(text, options.columns, 2) : TableLines{truncated(text, options.columns)};
  for (std::string& line : lines) line = styled(line, TextStyle::faint, options.colours);
  return lines;
}

void add_to(TableLines& lines, const TableLines& more) {
  lines.insert(lines.end(), more.begin(), more.end());
}

constexpr const char* kMeanings[] = {
    "bar: generations bred of those to be bred.",
    "gen: generations bred.",
    "best, median: fitness of the island's best and of its middle formula; less is better.",
    "diff: share of its formulas that differ from each other.",
    "eval/s: formulas tried per second.",
    "sent, took: formulas sent to and taken from other islands.",
    "wait: share of the time that was spent waiting for others, not computing.",
    "by: the worker that breeds the island, w1 and so on as listed below."};

}  // namespace

std::vector<std::string> worker_lines(const Watched& watched, double now_s, const TableOptions& options) {
  const auto workers = watched.workers();
  if (workers.empty()) return {};
  const WorkerCells heading{"", "worker's host", "process", "slots", "islands", "eval/s", "wait"};
  TableLines lines{styled(worker_line(heading, options.columns), TextStyle::faint, options.colours)};
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
    const TextStyle ink = is_here                                            ? TextStyle::plain
                          : worker.presence == WatchedWorker::Presence::lost ? TextStyle::bad
                                                                             : TextStyle::faint;
    lines.push_back(styled(line, ink, options.colours));
  }
  return with_last_rows(std::move(lines), options);
}

std::vector<std::string> round_lines(const WatchedCalibration* calibration, const TableOptions& options) {
  if (calibration == nullptr || calibration->rounds.empty()) return {};
  const auto added = std::ranges::count_if(
      calibration->rounds, [](const auto& round) { return round.second.verdict == LoopNews::Verdict::added; });
  const std::string heading =
      fmt::format("{} effect{} found; mean error on validation poses, mm", added, added == 1 ? "" : "s");
  TableLines lines = faint_lines(heading, options);
  for (const auto& [number, round] : calibration->rounds) {
    const TextStyle ink = round.verdict == LoopNews::Verdict::added ? TextStyle::good : TextStyle::faint;
    for (const std::string& line : round_row_lines(round, options)) {
      lines.push_back(styled(line, ink, options.colours));
    }
  }
  return with_last_rows(std::move(lines), options);
}

std::vector<std::string> cause_lines(const WatchedCalibration* calibration, const TableOptions& options) {
  if (calibration == nullptr || calibration->causes.empty()) return {};
  const std::size_t count = calibration->causes.size();
  const std::string heading =
      fmt::format("{} cause{} of error; rms error on validation poses while unseen, without it -> with it, mm", count,
                  count == 1 ? "" : "s");
  TableLines lines = faint_lines(heading, options);
  std::size_t shown = 0;
  for (const auto& [number, cause] : calibration->causes) {
    if (options.rows != 0 && shown++ >= options.rows) break;
    const std::string figures = from_to_in_mm(cause.without_m, cause.with_m);
    add_to(lines, numbered_lines({number, cause.label, figures, cause.advice}, options));
  }
  return lines;
}

std::vector<std::string> event_lines(const Watched& watched, double now_s, const TableOptions& options) {
  const auto& notices = watched.notices();
  if (notices.empty()) return {};
  const std::size_t count = notices.size();
  TableLines lines;
  for (std::size_t i = options.rows != 0 && count > options.rows ? count - options.rows : 0; i < count; ++i) {
    const std::string text = short_time(now_s - notices[i].time_s) + " ago: " + notices[i].text;
    add_to(lines, faint_lines(text, options));
  }
  return lines;
}

std::vector<std::string> column_legend(std::size_t columns, bool colours) {
  std::string text;
  for (const char* const meaning : kMeanings) text += std::string(text.empty() ? "" : " ") + meaning;
  return faint_lines(text, {columns, 0, colours, true});
}

std::string progress_bar(const Watched& watched, std::size_t columns, bool colours) {
  const WatchedRun* const run = watched.run();
  if (run == nullptr || !run->has_data()) return {};
  const WatchedCalibration* const calibration = watched.calibration();
  std::size_t before = 0;
  if (calibration != nullptr) {
    const auto& runs = calibration->runs;
    before = static_cast<std::size_t>(std::ranges::find(runs, run->data.run) - runs.begin());
    if (before == runs.size()) before = 0;
  }
  std::string end = fmt::format(" {:>4}", percent(share_done(*run)));
  if (before > 0) end += fmt::format(" ({} evolution{} done)", before, before == 1 ? "" : "s");
  constexpr std::size_t kFewestForPart = 4;
  const std::size_t room = columns - display_width(end);
  const std::size_t parts = std::min(before, room / kFewestForPart - 1) + 1, part = room / parts;
  std::string bar;
  for (std::size_t i = 0; i < parts; ++i) {
    const bool is_last = i + 1 == parts;
    const BarParts one = bar_parts(is_last ? share_done(*run) : 1.0, is_last ? room - part * i : part - 1);
    bar += styled(one.full, TextStyle::bar, colours) + styled(one.empty, TextStyle::faint, colours);
    if (!is_last) bar += ' ';
  }
  return bar + end;
}

}  // namespace demecal::inline terminal
