#include "coordinator/displays.hpp"

#include <fmt/format.h>
#include <sys/ioctl.h>
#include <unistd.h>
#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <utility>

#include "effects/effect.hpp"
#include "evolution/island.hpp"
#include "report/make_report.hpp"
#include "report/report.hpp"
#include "terminal/monitor_page.hpp"

namespace demecal {
namespace {

constexpr std::chrono::seconds kPlainInterval{2};

constexpr std::chrono::seconds kHoldBack{1};

std::string outcome_of(const Round& round) {
  if (round.verdict != Verdict::added) return "not added: " + round.reason;
  if (!std::isfinite(round.validation_before_mm)) return fmt::format("added, p {:.2g}", round.p_family);
  return fmt::format("added, validation {:.4f} -> {:.4f} mm", round.validation_before_mm, round.validation_after_mm);
}

constexpr std::chrono::milliseconds kSoonest{150};
constexpr std::chrono::milliseconds kLatest{1000};
constexpr const char* kOtherScreen = "\033[?1049h\033[?25l";
constexpr const char* kBack = "\033[?1049l\033[?25h";

struct Size {
  std::size_t columns = 100, lines = 0;
};

Size terminal_size(std::FILE* out) {
  winsize size{};
  if (::ioctl(::fileno(out), TIOCGWINSZ, &size) == 0 && size.ws_col > 0) return {size.ws_col, size.ws_row};
  const char* const columns = std::getenv("COLUMNS");
  const long width = columns == nullptr ? 0 : std::strtol(columns, nullptr, 10);
  return width > 0 && width < 1000 ? Size{static_cast<std::size_t>(width), 0} : Size{};
}

std::string with_line_ends(const std::vector<std::string>& lines, const char* end) {
  std::string text;
  for (const std::string& line : lines) text += line + end;
  return text;
}

}  // namespace

ProgressDisplay::ProgressDisplay(std::FILE* out, const CalibrationData& data, bool quiet)
    : out_(out),
      quiet_(quiet),
      terminal_(::isatty(::fileno(out)) == 1),
      parameters_(data.parameters),
      archipelago_(data.archipelago),
      breeds_(data.breeds),
      last_plain_(std::chrono::steady_clock::now()) {}

void ProgressDisplay::on_progress(const Progress& progress) {
  Progress& last = last_[progress.island];
  if (progress.epoch < last.epoch) return;
  last = progress;
  changed_ = true;
}

void ProgressDisplay::on_worker(const WorkerStatus& status) {
  if (!workers_.try_emplace(status.worker, status.slots).second) return;
  say(fmt::format("worker {} joined with {} slot{}", status.worker, status.slots, status.slots == 1 ? "" : "s"));
}

void ProgressDisplay::on_lost(const std::string& worker) {
  if (workers_.erase(worker) > 0) say(fmt::format("worker {} left", worker));
}

void ProgressDisplay::on_tick() {
  if (quiet_ || !changed_) return;
  const auto now = std::chrono::steady_clock::now();
  if (!terminal_ && now - last_plain_ < kPlainInterval) return;
  last_plain_ = now;
  redraw();
}

void ProgressDisplay::finish() {
  if (!quiet_ && changed_) redraw();
  drawn_lines_ = 0;
}

/// One joint: the generation its slowest island has reached, its best fitness so far, its islands' speed together.
std::string ProgressDisplay::line(std::uint32_t joint) const {
  std::uint32_t generation = std::numeric_limits<std::uint32_t>::max();
  double best = std::numeric_limits<double>::infinity(), speed = 0.0;
  for (std::uint32_t deme = 0; deme < archipelago_.demes_per_joint; ++deme) {
    const auto found = last_.find({joint, deme});
    const Progress progress = found == last_.end() ? Progress{} : found->second;
    generation = std::min(generation, progress.generation);
    if (found == last_.end()) continue;
    best = std::min(best, progress.figures.best);
    speed += progress.evaluations_per_s;
  }
  const std::string fitness = std::isfinite(best) ? fmt::format("{:.4g}", best) : "-";
  const std::string name = breeds_ == Breeds::sets ? "explanations" : fmt::format("joint {}", joint + 1);
  return fmt::format("  {}  generation {:>5}/{}  best fitness {:>10}  {:>9.0f} {}/s", name, generation,
                     parameters_.number_generations, fitness, speed, breeds_ == Breeds::sets ? "sets" : "evaluations");
}

void ProgressDisplay::redraw() {
  changed_ = false;
  if (terminal_ && drawn_lines_ > 0) fmt::print(out_, "\033[{}A", drawn_lines_);
  for (const std::uint32_t joint : archipelago_.joints) {
    fmt::print(out_, "{}{}\n", line(joint), terminal_ ? "\033[K" : "");
  }
  std::fflush(out_);
  drawn_lines_ = archipelago_.joints.size();
}

void ProgressDisplay::say(const std::string& text) {
  if (quiet_) return;
  fmt::print(out_, "  {}{}\n", text, terminal_ ? "\033[K" : "");
  drawn_lines_ = 0;
}

LoopDisplay::LoopDisplay(std::FILE* out, const Robot& described, bool quiet)
    : out_(out),
      described_(described),
      quiet_(quiet),
      terminal_(::isatty(::fileno(out)) == 1),
      begin_(std::chrono::steady_clock::now()) {}

void LoopDisplay::on_round(const Round& round) {
  const std::string name = round.effect.kind.empty() ? "nothing" : effect_entry(round.effect, described_).name();
  say(fmt::format("closing the loop: round {}: {}, {}", round.number, name, outcome_of(round)));
}

void LoopDisplay::say(const std::string& text) {
  if (quiet_) return;
  held_back_.push_back(text);
  if (!terminal_ && std::chrono::steady_clock::now() - begin_ < kHoldBack) return;
  for (const std::string& line : held_back_) fmt::print(out_, "  {}\n", line);
  held_back_.clear();
  std::fflush(out_);
}

void ConsoleObserver::on_run_begins(const CalibrationData& data, const std::vector<Progress>& reached, bool shown) {
  run_.emplace(stderr, data, quiet_ || !shown);
  for (const Progress& progress : reached) run_->on_progress(progress);
}

void ConsoleObserver::on_run_ends(RunEnd /*end*/) {
  run_->finish();
}

void ConsoleObserver::on_learning_begins(const Robot& described) {
  loop_.emplace(stderr, described, quiet_);
}

void ConsoleObserver::on_structure_generation(int generation, int generations, double left) {
  constexpr int kBetweenLines = 10;
  if (quiet_ || generation % kBetweenLines != 0) return;
  fmt::print(stderr, "  generation {} of {}: the best structure leaves {:.1f} % of the validation poses' squares\n",
             generation, generations, 1e2 * left);
}

MonitorScreen::MonitorScreen(std::FILE* out, std::string place)
    : out_(out),
      place_(std::move(place)),
      terminal_(::isatty(::fileno(out)) == 1),
      colours_(terminal_ && std::getenv("NO_COLOR") == nullptr) {}

MonitorScreen::~MonitorScreen() {
  if (!in_place_) return;
  std::fputs(kBack, out_);
  std::fputs(last_.c_str(), out_);
  std::fflush(out_);
}

void MonitorScreen::offer(const Watched& watched, double now_s, bool changed) {
  changed_ = changed_ || changed;
  const auto since = Clock::now() - drawn_;
  const bool is_due = terminal_ ? since >= kLatest || (changed_ && since >= kSoonest) : changed_ && since >= kLatest;
  if (is_due) draw(watched, now_s);
}

void MonitorScreen::toggle_legend() {
  legend_ = !legend_;
  changed_ = true;
  drawn_ = {};  // at once: whoever pressed a key waits
}

void MonitorScreen::settle(const Watched& watched, double now_s) {
  if (changed_) draw(watched, now_s);
}

void MonitorScreen::draw(const Watched& watched, double now_s) {
  changed_ = false;
  drawn_ = Clock::now();
  if (terminal_) {
    redraw(watched, now_s);
  } else {
    print(watched, now_s);
    std::fputs("\n", out_);
    std::fflush(out_);
  }
}

void MonitorScreen::redraw(const Watched& watched, double now_s) {
  const Size size = terminal_size(out_);
  const auto page = [&](std::size_t lines) {
    const bool stays = lines == 0;  // once the keys are no longer read
    return monitor_page(watched, {size.columns, lines, colours_, now_s, place_, legend_ || stays, keys_ && !stays});
  };
  if (!std::exchange(in_place_, true)) std::fputs(kOtherScreen, out_);
  // The last line ends without a line break: it would move the page up.
  std::string text = with_line_ends(page(size.lines), "\033[K\r\n");
  text.resize(text.size() - 2);
  std::fputs(("\033[H" + text + "\033[J").c_str(), out_);
  std::fflush(out_);
  last_ = with_line_ends(page(0), "\n");
}

void MonitorScreen::print(const Watched& watched, double now_s) {
  const Size size = terminal_size(out_);
  std::fputs(with_line_ends(monitor_page(watched, {size.columns, 0, colours_, now_s, place_, true}), "\n").c_str(),
             out_);
  std::fflush(out_);
}

}  // namespace demecal
