#include "coordinator/loop_display.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <cmath>

#include "report/make_report.hpp"

namespace demecal {
namespace {

constexpr std::chrono::seconds kPatience{1};

std::string outcome_of(const Round& round) {
  if (round.verdict != Verdict::added) return "not added: " + round.reason;
  if (!std::isfinite(round.validation_before_mm)) return fmt::format("added, p {:.2g}", round.p_family);
  return fmt::format("added, validation {:.4f} -> {:.4f} mm", round.validation_before_mm, round.validation_after_mm);
}

}  // namespace

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
  if (!terminal_ && std::chrono::steady_clock::now() - begin_ < kPatience) return;
  for (const std::string& line : held_back_) fmt::print(out_, "  {}\n", line);
  held_back_.clear();
  std::fflush(out_);
}

}  // namespace demecal
