#include "coordinator/progress_display.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace demecal {
namespace {

constexpr std::chrono::seconds kPlainInterval{2};

}  // namespace

ProgressDisplay::ProgressDisplay(std::FILE* out, const CalibrationData& data, bool quiet)
    : out_(out),
      quiet_(quiet),
      terminal_(::isatty(::fileno(out)) == 1),
      parameters_(data.parameters),
      archipelago_(data.archipelago),
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
  return fmt::format("  joint {}  generation {:>5}/{}  best fitness {:>10}  {:>9.0f} evaluations/s", joint + 1,
                     generation, parameters_.number_generations, fitness, speed);
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

}  // namespace demecal
