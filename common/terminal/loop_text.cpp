#include "terminal/report_text.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <map>
#include <memory>
#include <optional>
#include <ranges>
#include <string>
#include <utility>
#include <vector>

#include "effects/catalogue.hpp"
#include "report/figures.hpp"
#include "report/report.hpp"
#include "terminal/text.hpp"

namespace demecal::inline terminal {
namespace {

constexpr std::size_t kIndent = 7;          // of what is said of one effect
constexpr std::size_t kMostHarmonics = 12;  // that take a line each
constexpr std::size_t kMostNamedRivals = 3;
constexpr std::size_t kMostRefused = 2;
constexpr std::size_t kMostNameLetters = 42, kSizeLetters = 13;
constexpr std::size_t kMostDiagnoses = 8;  // effects, for each to get its sentence

using Rounds = std::vector<const RoundEntry*>;

Rounds added_rounds(const Report& report) {
  Rounds rounds;
  for (const RoundEntry& round : report.rounds) {
    if (round.added()) rounds.push_back(&round);
  }
  return rounds;
}

bool adds_harmonic(const RoundEntry* round) {
  return is_harmonic(round->effect.kind);
}

std::string mm_or_dash(std::optional<double> value) {
  return value ? fmt::format("{:.3f}", *value) : "–";
}

std::string round_columns(const std::string& number, const std::string& name, const std::string& size,
                          const std::string& p, const std::string& before, const std::string& after) {
  // A long size takes room of the name: a unit that is cut off is another unit.
  const std::size_t size_letters = std::max(kSizeLetters, display_width(size) + 1);
  const std::size_t name_letters = kMostNameLetters + kSizeLetters - size_letters;
  std::string line = right_aligned(number, 5) + "  " + left_aligned(name, name_letters) +
                     right_aligned(size, size_letters) + right_aligned(p, 9) + right_aligned(before, 12);
  return line + (after.empty() ? "" : " -> " + after) + "\n";
}

std::string rounds_heading() {
  return round_columns("", "effect added", "size", "p", "validation", "after, mm");
}

/// Rivals that the name of the effect's class does not hold already: that holds the nearest of each kind and joint.
std::vector<const RivalEntry*> rivals_beyond_class(const RoundEntry& round) {
  std::vector<const RivalEntry*> beyond;
  std::vector<std::pair<std::string, std::optional<std::uint64_t>>> held{{round.effect.kind, round.effect.joint}};
  for (const RivalEntry& rival : round.rivals) {
    const std::pair place{rival.effect.kind, rival.effect.joint};
    const bool is_member = std::ranges::any_of(round.members, [&place](const ClassMember& member) {
      return member.kind == place.first && member.joint == place.second;
    });
    if (is_member && std::ranges::find(held, place) == held.end()) {
      held.push_back(place);
    } else {
      beyond.push_back(&rival);
    }
  }
  return beyond;
}

std::string rivals_line(const RoundEntry& round) {
  const std::vector<const RivalEntry*> rivals = rivals_beyond_class(round);
  if (rivals.empty()) return {};
  std::string names;
  for (std::size_t i = 0; i < std::min(rivals.size(), kMostNamedRivals); ++i) {
    names += fmt::format("{}{} (cosine {:.2f})", names.empty() ? "" : "; ", rivals[i]->effect.full_name(),
                         rivals[i]->cosine.value_or(0.0));
  }
  if (rivals.size() > kMostNamedRivals) names += fmt::format("; {} more", rivals.size() - kMostNamedRivals);
  return wrapped(std::string(kIndent, ' ') + "cannot be distinguished with these poses from:", names, kIndent + 2);
}

std::string next_measurement_line(const RoundEntry& round) {
  if (!round.next_measurement) return {};
  return wrapped(std::string(kIndent, ' ') + "measure next:", round.next_measurement->sentence, kIndent + 2);
}

std::string effect_lines(const RoundEntry& round, bool diagnosed) {
  const EffectEntry& effect = round.effect;
  const std::string margin(kIndent - 1, ' ');
  const std::string class_name = class_text(round.members);
  const std::string name = round.members.empty() ? effect.name()
                           : class_name.size() <= kMostNameLetters
                               ? class_name
                               : class_text({round.members.front()}) + " or another";
  std::string text = round_columns(std::to_string(round.round), name, effect.size(), probability(round.p_family),
                                   mm_or_dash(round.validation_before_mm), mm_or_dash(round.validation_after_mm));
  if (!round.members.empty()) {
    text += wrapped(margin, fmt::format("{} The model has it as {}.", round.class_sentence, effect.name()), kIndent);
  }
  if (diagnosed && !round.diagnosis.empty())
    text += wrapped(margin, (round.members.empty() ? "" : "If that is right: ") + round.diagnosis, kIndent);
  return text + rivals_line(round) + next_measurement_line(round);
}

std::string harmonics_lines(const Rounds& rounds) {
  std::vector<EffectEntry> effects;
  std::size_t doubtful = 0;
  double p = 0.0;
  for (const RoundEntry* const round : rounds) {
    effects.push_back(round->effect);
    p = std::max(p, round->p_family.value_or(0.0));
    doubtful += round->rivals.empty() ? 0 : 1;
  }
  // What they did to the error is known where nothing else was added between them.
  const bool together = rounds.back()->round - rounds.front()->round + 1 == rounds.size();
  std::string text = round_columns("", fmt::format("{} gear harmonics", rounds.size()), "", probability(p),
                                   together ? mm_or_dash(rounds.front()->validation_before_mm) : "",
                                   together ? mm_or_dash(rounds.back()->validation_after_mm) : "");
  for (const auto& [joint, harmonics] : harmonics_of(effects)) {
    text +=
        wrapped(fmt::format("{}joint {}:", std::string(kIndent, ' '), joint), harmonics_text(harmonics), kIndent + 2);
  }
  if (doubtful > 0) {
    text +=
        wrapped(std::string(kIndent - 1, ' '),
                fmt::format("{} of them cannot be distinguished from other effects with these poses: see report.html",
                            doubtful),
                kIndent);
  }
  return text;
}

std::string added_lines(Rounds rounds) {
  if (rounds.empty()) return "  the closed loop added no effect\n";
  Rounds harmonics;
  if (static_cast<std::size_t>(std::ranges::count_if(rounds, adds_harmonic)) > kMostHarmonics) {
    std::ranges::copy_if(rounds, std::back_inserter(harmonics), adds_harmonic);
    std::erase_if(rounds, adds_harmonic);
  }
  std::string text = rounds_heading();
  for (const RoundEntry* const round : rounds) text += effect_lines(*round, rounds.size() <= kMostDiagnoses);
  return harmonics.empty() ? text : text + harmonics_lines(harmonics);
}

/// The best candidate of the last round, where it was not added.
std::string last_candidate(const Report& report) {
  if (report.rounds.empty() || report.rounds.back().added()) return {};
  const RoundEntry& last = report.rounds.back();
  if (last.effect.kind.empty() || last.implausible) return {};
  const bool says_p = last.reason.find("(p = ") != std::string::npos;
  return wrapped("  tried last, not added:",
                 fmt::format("{}{}{}{}", last.effect.name(), says_p ? "" : ", p " + probability(last.p_family),
                             last.reason.empty() ? "" : ": ", last.reason),
                 4);
}

/// What the data hold that no real arm has: said, since it is neither an effect nor absent.
std::string refused_lines(const Report& report) {
  std::string text;
  std::size_t refused = 0;
  for (const RoundEntry& round : report.rounds) {
    if (!round.implausible || ++refused > kMostRefused) continue;
    text += wrapped("  refused:", round.effect.name() + ": " + round.reason, 4);
  }
  if (refused > kMostRefused) text += fmt::format("  {} more refused: see report.html\n", refused - kMostRefused);
  return text;
}

std::string dropped_line(const Report& report) {
  std::string names;
  for (const EffectEntry& effect : report.dropped) names += (names.empty() ? "" : "; ") + effect.full_name();
  return names.empty() ? names : wrapped("  added, and taken back:", names, 4);
}

std::string unexplained_lines(const Report& report) {
  if (!report.unexplained) return {};
  return wrapped(" ", unexplained_sentence(*report.unexplained) + ' ' + report.unexplained->advice, 4);
}

/// What it comes to, for who asks what to do about it.
std::string causes_lines(const Report& report) {
  if (report.causes.empty()) return unexplained_lines(report) + (report.unexplained ? "\n" : "");
  std::string text = fmt::format("  causes, by the rise of the error on {} poses without each (to first order)\n",
                                 judging_set(report));
  for (std::size_t i = 0; i < report.causes.size(); ++i) {
    const std::string number = fmt::format("{:>5}.", i + 1);
    const std::string& advice = report.causes[i].advice;
    const auto first =
        static_cast<std::size_t>(std::ranges::find(report.causes, advice, &CauseEntry::advice) - report.causes.begin());
    const std::string told = first < i ? fmt::format(" What to do: as of {}.", first + 1) : "";
    text += wrapped(number, cost_sentence(report.causes[i]) + told, kIndent);
    if (first == i) text += wrapped(std::string(kIndent - 1, ' '), advice, kIndent);
  }
  const std::string fewer = front_sentence(report);
  return text + unexplained_lines(report) + (fewer.empty() ? "" : wrapped(" ", fewer, 4)) + "\n";
}

}  // namespace

std::string loop_to_terminal(const Report& report) {
  if (!report.loop_ran()) return {};
  const std::string closing = stop_sentence(report.stopped) + " " + statistics_sentences(report);
  const std::string doubt = doubt_sentence(report);
  return (doubt.empty() ? "" : wrapped(" ", doubt, 4) + "\n") + causes_lines(report) +
         added_lines(added_rounds(report)) + refused_lines(report) + dropped_line(report) + last_candidate(report) +
         wrapped(" ", closing, 4) + limits_to_terminal(report);
}

}  // namespace demecal::inline terminal
