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
  Lines title() const;
  std::string keys_line() const;
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

std::string Page::keys_line() const {
  const char* const about = options_.legend ? "?: hide what the columns mean" : "?: what the columns mean";
  return paint(truncated(std::string("q: leave, the run goes on   ") + about, columns_), TextStyle::faint);
}

Lines Page::title() const {
  std::string name = calibration_ != nullptr ? calibration_->stage.job : "";
  if (name.empty() && run_ != nullptr) name = run_->data.job;
  std::string text = "demecal monitor";
  if (!name.empty()) text += "  " + name;
  const bool evolves = run_ != nullptr && run_->has_data();
  const std::string size = evolves ? fmt::format("{} generations", run_->data.parameters.number_generations) : "";
  text += "  " + stage();
  if (options_.lines == 0 && display_width(text) > columns_) return wrapped_lines(text, columns_, 2);
  return {both_ends(text, size, columns_)};
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

/// How far the run is: a bar over the whole width, and what the islands of all evolutions did together.
Lines Page::progress() const {
  if (run_ == nullptr || !run_->has_data()) return {};
  const auto [evaluations, sets, migrants] = watched_.effort();
  std::string counts = short_count(static_cast<double>(evaluations)) + " evaluations";
  if (sets > 0) counts += ", " + short_count(static_cast<double>(sets)) + " sets of effects";
  const double speed = is_evolving() ? evaluations_per_s(watched_, *run_, options_.now_s) : 0.0;
  if (speed > 0.0) counts += ", " + short_count(speed) + "/s";
  counts += ", " + short_count(static_cast<double>(migrants)) + " migrants taken";
  return {progress_bar(watched_, columns_, options_.colours), both_ends(counts, time_left(), columns_)};
}

/// What stands under the islands.
Lines Page::below() const {
  const bool is_short = options_.lines != 0;
  Lines lines;
  const TableOptions some{columns_, is_short ? 6U : 0U, options_.colours, !is_short};
  const TableOptions latest{columns_, 3, options_.colours, !is_short};
  for (const Lines& table : {worker_lines(watched_, options_.now_s, some), round_lines(calibration_, some),
                             cause_lines(calibration_, some), event_lines(watched_, options_.now_s, latest)}) {
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
    Lines lines = wrapped_lines("demecal monitor: nobody is calibrating in " + options_.place + " yet", columns_, 2);
    if (!options_.keys) return lines;
    if (options_.legend) {
      for (const std::string& line : column_legend(columns_, options_.colours)) lines.push_back(line);
    }
    lines.push_back(keys_line());
    return lines;
  }
  Lines lines;
  for (const std::string& line : title()) lines.push_back(paint(line, TextStyle::strong));
  for (const std::string& line : progress()) lines.push_back(line);
  if (options_.legend && run_ != nullptr && run_->has_data()) {
    for (const std::string& line : column_legend(columns_, options_.colours)) lines.push_back(line);
  }
  const Lines under = below();
  if (run_ != nullptr && run_->has_data()) {
    const std::size_t taken = lines.size() + 1 + under.size() + (options_.keys ? 1 : 0);
    const std::size_t room = options_.lines > taken ? options_.lines - taken : 0;
    const std::size_t grid_lines = options_.lines == 0 ? 0 : std::max(room, kFewestGridLines);
    lines.emplace_back();
    for (const std::string& line : island_grid(*run_, watched_.workers(), {columns_, grid_lines, options_.colours})) {
      lines.push_back(line);
    }
  }
  lines.insert(lines.end(), under.begin(), under.end());
  const std::size_t room = options_.lines - (options_.keys && options_.lines > 1 ? 1 : 0);
  if (options_.lines != 0 && lines.size() > room) lines.resize(room);
  if (options_.keys) lines.push_back(keys_line());
  return lines;
}

}  // namespace

std::vector<std::string> monitor_page(const Watched& watched, const PageOptions& options) {
  return Page(watched, options).lines();
}

}  // namespace demecal::inline terminal
