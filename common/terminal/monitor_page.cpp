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

using Lines = std::vector<std::string>;

/// Keeps the heading and the last rows, and says how many are missing.
Lines with_last_rows(Lines lines, const TableOptions& options) {
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

std::string numbered_line(const NumberedCells& cells, std::size_t columns) {
  const std::size_t room = columns - 5 - 20;
  const std::size_t label_room = std::min<std::size_t>(room, 42);
  std::string line = right_aligned(std::to_string(cells.number), 3) + "  " + left_aligned(cells.label, label_room) +
                     right_aligned(cells.figures, 20);
  if (columns > display_width(line) + 20 && !cells.text.empty()) {
    line += "  " + truncated(cells.text, columns - display_width(line) - 2);
  }
  return line;
}

std::string from_to_in_mm(double from_m, double to_m) {
  return metres_in_mm(from_m) + " -> " + metres_in_mm(to_m);
}

std::string round_line(const LoopNews& round, std::size_t columns) {
  const bool is_added = round.verdict == LoopNews::Verdict::added;
  return numbered_line(
      {round.round, round.label.empty() ? "nothing" : round.label,
       is_added ? from_to_in_mm(round.validation_before_m, round.validation_after_m) : to_string(round.verdict),
       round.text},
      columns);
}

using Lines = std::vector<std::string>;

constexpr std::size_t kFewestColumns = 40;
constexpr std::size_t kFewestGridLines = 4;

/// `first` at the left end, `last` at the right end where both fit.
std::string both_ends(const std::string& first, const std::string& last, std::size_t columns) {
  if (last.empty()) return truncated(first, columns);
  const std::size_t taken = display_width(first) + display_width(last) + 2;
  return taken > columns ? truncated(first, columns) : first + std::string(columns + 2 - taken, ' ') + last;
}

class Page {
 public:
  Page(const Watched& watched, const PageOptions& options)
      : watched_(watched),
        options_(options),
        columns_(std::max(options.columns, kFewestColumns)),
        calibration_(watched.calibration()),
        run_(watched.run()) {}

  Lines lines() const;

 private:
  bool is_evolving() const;
  std::string title() const;
  std::string stage() const;
  std::string time_left() const;
  Lines progress() const;
  Lines below() const;
  std::string paint(const std::string& text, TextStyle ink) const { return styled(text, ink, options_.colours); }

  const Watched& watched_;
  const PageOptions& options_;
  std::size_t columns_;
  const WatchedCalibration* calibration_;
  const WatchedRun* run_;
};

std::string Page::stage() const {
  if (calibration_ == nullptr) return run_ == nullptr ? "no calibration" : "run " + to_string(run_->state);
  if (calibration_->lost) return "its coordinator is gone: waiting for the next calibration";
  const LoopNews& news = calibration_->stage;
  if (!news.text.empty()) return news.text;
  return to_string(news.stage);
}

std::string Page::title() const {
  std::string name = calibration_ != nullptr ? calibration_->stage.job : "";
  if (name.empty() && run_ != nullptr) name = run_->data.job;
  std::string text = "demecal monitor";
  if (!name.empty()) text += "  " + name;
  const bool evolves = run_ != nullptr && run_->has_data();
  const std::string size = evolves ? fmt::format("{} generations", run_->data.parameters.number_generations) : "";
  return both_ends(text + "  " + stage(), size, columns_);
}

bool Page::is_evolving() const {
  return run_ != nullptr && run_->state == Control::State::running &&
         (calibration_ == nullptr || calibration_->is_live());
}

std::string Page::time_left() const {
  if (!is_evolving()) return "";
  const auto left = time_left_s(watched_, *run_, options_.now_s);
  return left && *left > 0.0 ? "about " + short_time(*left) + " left" : "";
}

/// How far the run is: a bar over the whole width, and what the islands did together.
Lines Page::progress() const {
  if (run_ == nullptr || !run_->has_data()) return {};
  double taken = 0.0;
  for (const auto& [key, island] : run_->islands) taken += static_cast<double>(island.migrants_taken);
  const std::string end = fmt::format(" {:>4}", percent(share_done(*run_)));
  const BarParts parts = bar_parts(share_done(*run_), columns_ - display_width(end));
  std::string counts = short_count(static_cast<double>(run_->evaluations)) + " evaluations";
  const double speed = is_evolving() ? evaluations_per_s(watched_, *run_, options_.now_s) : 0.0;
  if (speed > 0.0) counts += ", " + short_count(speed) + "/s";
  counts += ", " + short_count(taken) + " migrants taken";
  return {paint(parts.full, TextStyle::bar) + paint(parts.empty, TextStyle::faint) + end,
          both_ends(counts, time_left(), columns_)};
}

/// What stands under the islands.
Lines Page::below() const {
  const bool is_short = options_.lines != 0;
  Lines lines;
  for (const Lines& table : {worker_lines(watched_, options_.now_s, {columns_, is_short ? 6U : 0U, options_.colours}),
                             round_lines(calibration_, {columns_, is_short ? 6U : 0U, options_.colours}),
                             cause_lines(calibration_, {columns_, is_short ? 6U : 0U, options_.colours}),
                             event_lines(watched_, options_.now_s, {columns_, 3, options_.colours})}) {
    if (table.empty()) continue;
    lines.emplace_back();
    lines.insert(lines.end(), table.begin(), table.end());
  }
  if (const std::size_t others = watched_.other_calibrations(); others > 0) {
    lines.push_back(fmt::format("{} other calibration{} going on here", others, others == 1 ? " is" : "s are"));
  }
  return lines;
}

Lines Page::lines() const {
  if (!watched_.has_seen_anything()) {
    return {truncated("demecal monitor  nobody is calibrating in " + options_.place + " yet", columns_)};
  }
  Lines lines{paint(title(), TextStyle::strong)};
  for (const std::string& line : progress()) lines.push_back(line);
  const Lines under = below();
  if (run_ != nullptr && run_->has_data()) {
    const std::size_t taken = lines.size() + 1 + under.size();
    const std::size_t room = options_.lines > taken ? options_.lines - taken : 0;
    const std::size_t grid_lines = options_.lines == 0 ? 0 : std::max(room, kFewestGridLines);
    lines.emplace_back();
    for (const std::string& line : island_grid(*run_, watched_.workers(), {columns_, grid_lines, options_.colours})) {
      lines.push_back(line);
    }
  }
  lines.insert(lines.end(), under.begin(), under.end());
  if (options_.lines != 0 && lines.size() > options_.lines) lines.resize(options_.lines);
  return lines;
}

}  // namespace

std::vector<std::string> worker_lines(const Watched& watched, double now_s, const TableOptions& options) {
  const auto workers = watched.workers();
  if (workers.empty()) return {};
  const WorkerCells heading{"", "worker's host", "process", "slots", "islands", "eval/s", "wait"};
  Lines lines{styled(worker_line(heading, options.columns), TextStyle::faint, options.colours)};
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
  Lines lines{styled(truncated(heading, options.columns), TextStyle::faint, options.colours)};
  for (const auto& [number, round] : calibration->rounds) {
    const TextStyle ink = round.verdict == LoopNews::Verdict::added ? TextStyle::good : TextStyle::faint;
    lines.push_back(styled(round_line(round, options.columns), ink, options.colours));
  }
  return with_last_rows(std::move(lines), options);
}

std::vector<std::string> cause_lines(const WatchedCalibration* calibration, const TableOptions& options) {
  if (calibration == nullptr || calibration->causes.empty()) return {};
  const std::size_t count = calibration->causes.size();
  const std::string heading = fmt::format(
      "{} cause{} of error; rms error on validation poses without it -> with it, mm", count, count == 1 ? "" : "s");
  Lines lines{styled(truncated(heading, options.columns), TextStyle::faint, options.colours)};
  for (const auto& [number, cause] : calibration->causes) {
    if (options.rows != 0 && lines.size() > options.rows) break;
    const std::string figures = from_to_in_mm(cause.without_m, cause.with_m);
    lines.push_back(numbered_line({number, cause.label, figures, cause.advice}, options.columns));
  }
  return lines;
}

std::vector<std::string> event_lines(const Watched& watched, double now_s, const TableOptions& options) {
  const auto& notices = watched.notices();
  if (notices.empty()) return {};
  const std::size_t count = notices.size();
  Lines lines;
  for (std::size_t i = options.rows != 0 && count > options.rows ? count - options.rows : 0; i < count; ++i) {
    const std::string text = short_time(now_s - notices[i].time_s) + " ago: " + notices[i].text;
    lines.push_back(styled(truncated(text, options.columns), TextStyle::faint, options.colours));
  }
  return lines;
}

std::vector<std::string> monitor_page(const Watched& watched, const PageOptions& options) {
  return Page(watched, options).lines();
}

}  // namespace demecal::inline terminal
