#include "report/loop_terminal.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "report/effect_class.hpp"
#include "report/effect_entry.hpp"
#include "report/harmonics.hpp"
#include "report/loop_limits.hpp"
#include "report/loop_words.hpp"
#include "report/terminal_text.hpp"

namespace demecal {
namespace {

constexpr std::size_t kIndent = 7;          // of what is said of one effect
constexpr std::size_t kMostHarmonics = 12;  // that take a line each
constexpr std::size_t kMostRivals = 3;
constexpr std::size_t kMostRefused = 2;
constexpr std::size_t kMostNameLetters = 42;
constexpr std::size_t kMostDiagnoses = 8;  // effects, for each to get its sentence

using Rounds = std::vector<const Round*>;

Rounds added_rounds(const LoopOutcome& loop) {
  Rounds rounds;
  for (const Round& round : loop.rounds) {
    if (round.verdict == Verdict::added) rounds.push_back(&round);
  }
  return rounds;
}

bool is_harmonic(const Round* round) {
  return round->effect.kind == "gear_harmonic";
}

std::string mm(double value) {
  return std::isfinite(value) ? fmt::format("{:.3f}", value) : "–";
}

std::string columns(const std::string& number, const std::string& name, const std::string& size, const std::string& p,
                    const std::string& before, const std::string& after) {
  std::string line =
      right(number, 5) + "  " + left(name, kMostNameLetters) + right(size, 13) + right(p, 9) + right(before, 12);
  return line + (after.empty() ? "" : " -> " + after) + "\n";
}

std::string heading() {
  return columns("", "effect added", "size", "p", "validation", "after, mm");
}

/// Rivals that the name of the effect's class does not hold already.
std::string rivals_line(const Round& round, const std::vector<Effect>& members, const Robot& robot) {
  std::string names;
  std::size_t named = 0, more = 0;
  for (const Rival& rival : round.rivals) {
    const auto is_it = [&rival](const Effect& member) { return member.same_law_as(rival.effect); };
    if (std::ranges::any_of(members, is_it)) continue;
    if (++named > kMostRivals) {
      ++more;
      continue;
    }
    names += fmt::format("{}{} (cosine {:.2f})", names.empty() ? "" : "; ", effect_entry(rival.effect, robot).name(),
                         rival.cosine);
  }
  if (names.empty()) return {};
  if (more > 0) names += fmt::format("; {} more", more);
  return wrapped(std::string(kIndent, ' ') + "cannot be distinguished with these poses from:", names, kIndent + 2);
}

std::string further_line(const Round& round) {
  if (!round.further) return {};
  return wrapped(std::string(kIndent, ' ') + "measure next:", round.further->sentence, kIndent + 2);
}

std::string effect_lines(const Round& round, const Robot& robot, bool diagnosed) {
  const EffectEntry effect = effect_entry(round.effect, robot);
  const std::vector<Effect> members = effect_class(round);
  const std::string margin(kIndent - 1, ' ');
  const std::string class_name = class_words(members);
  const std::string name = members.empty()                         ? effect.name()
                           : class_name.size() <= kMostNameLetters ? class_name
                                                                   : class_words({members.front()}) + " or another";
  std::string text = columns(std::to_string(round.number), name, effect.size(), probability(round.p_family),
                             mm(round.validation_before_mm), mm(round.validation_after_mm));
  if (!members.empty()) {
    text += wrapped(margin, fmt::format("{} The model has it as {}.", class_sentence(members), effect.name()), kIndent);
  }
  if (diagnosed && !round.diagnosis.empty())
    text += wrapped(margin, (members.empty() ? "" : "If that is right: ") + round.diagnosis, kIndent);
  return text + rivals_line(round, members, robot) + further_line(round);
}

std::string harmonics_lines(const Rounds& rounds, const Robot& robot) {
  std::vector<EffectEntry> effects;
  std::size_t doubtful = 0;
  double p = 0.0;
  for (const Round* const round : rounds) {
    effects.push_back(effect_entry(round->effect, robot));
    p = std::max(p, round->p_family);
    doubtful += round->rivals.empty() ? 0 : 1;
  }
  // What they did to the error is known where nothing else was added between them.
  const bool together = rounds.back()->number - rounds.front()->number + 1 == static_cast<int>(rounds.size());
  std::string text = columns("", fmt::format("{} gear harmonics", rounds.size()), "", probability(p),
                             together ? mm(rounds.front()->validation_before_mm) : "",
                             together ? mm(rounds.back()->validation_after_mm) : "");
  for (const auto& [joint, harmonics] : harmonics_of(effects)) {
    text +=
        wrapped(fmt::format("{}joint {}:", std::string(kIndent, ' '), joint), harmonics_words(harmonics), kIndent + 2);
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

std::string added_lines(Rounds rounds, const Robot& robot) {
  if (rounds.empty()) return "  the closed loop added no effect\n";
  Rounds harmonics;
  if (static_cast<std::size_t>(std::ranges::count_if(rounds, is_harmonic)) > kMostHarmonics) {
    std::ranges::copy_if(rounds, std::back_inserter(harmonics), is_harmonic);
    std::erase_if(rounds, is_harmonic);
  }
  std::string text = heading();
  for (const Round* const round : rounds) text += effect_lines(*round, robot, rounds.size() <= kMostDiagnoses);
  return harmonics.empty() ? text : text + harmonics_lines(harmonics, robot);
}

/// The best candidate of the last round, where it was not added.
std::string last_candidate(const LoopOutcome& loop, const Robot& robot) {
  if (loop.rounds.empty() || loop.rounds.back().verdict == Verdict::added) return {};
  const Round& last = loop.rounds.back();
  if (last.effect.kind.empty() || last.implausible) return {};
  return wrapped("  tried last, not added:",
                 fmt::format("{}, p {}{}{}", effect_entry(last.effect, robot).name(), probability(last.p_family),
                             last.reason.empty() ? "" : ": ", last.reason),
                 4);
}

/// What the data hold that no real arm has: said, since it is neither an effect nor absent.
std::string refused_lines(const LoopOutcome& loop, const Robot& robot) {
  std::string text;
  std::size_t refused = 0;
  for (const Round& round : loop.rounds) {
    if (!round.implausible || ++refused > kMostRefused) continue;
    text += wrapped("  refused:", effect_entry(round.effect, robot).name() + ": " + round.reason, 4);
  }
  if (refused > kMostRefused) text += fmt::format("  {} more refused: see report.html\n", refused - kMostRefused);
  return text;
}

std::string dropped_line(const LoopOutcome& loop, const Robot& robot) {
  std::string names;
  for (const Effect& effect : loop.dropped) names += (names.empty() ? "" : "; ") + effect_entry(effect, robot).name();
  return names.empty() ? names : wrapped("  added, and taken back:", names, 4);
}

}  // namespace

bool loop_added(const LoopOutcome& loop) {
  return !added_rounds(loop).empty();
}

std::string loop_to_terminal(const LoopOutcome& loop, const Robot& described) {
  if (loop.stopped == StopReason::not_run) return {};
  const std::string closing = stop_sentence(word_of(loop.stopped)) + " " +
                              statistics_sentences({loop.lack_of_fit_p, loop.explained_share, loop.p_structure_left});
  return added_lines(added_rounds(loop), described) + refused_lines(loop, described) + dropped_line(loop, described) +
         last_candidate(loop, described) + wrapped(" ", closing, 4) + not_found_lines(loop, described) +
         untestable_line(loop) + unseen_line(loop) + noise_line(loop) + decoys_line(loop);
}

}  // namespace demecal
