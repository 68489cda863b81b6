#include "report/loop_limits.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "kinematics/units.hpp"
#include "report/amount.hpp"
#include "report/effect_entry.hpp"
#include "report/terminal_text.hpp"

namespace demecal {
namespace {

/// What an engineer asks for first.
constexpr std::array<const char*, 10> kAskedFirst{"backlash",       "compliance",    "eccentricity", "hysteresis",
                                                  "coupling",       "gear_harmonic", "axis_wobble",  "link_bending",
                                                  "thermal_offset", "drift"};
constexpr std::size_t kMostKinds = 5;

/// Places searched for one kind of effect in one unit.
struct Searched {
  std::string kind, unit;
  std::vector<const NotFound*> places;
};

std::size_t rank(const Searched& searched) {
  return static_cast<std::size_t>(std::ranges::find(kAskedFirst, searched.kind) - kAskedFirst.begin());
}

std::vector<Searched> by_kind(const std::vector<NotFound>& not_found) {
  std::vector<Searched> kinds;
  for (const NotFound& missing : not_found) {
    if (!std::isfinite(missing.smallest_detectable) || !missing.testable) continue;
    const auto same = [&missing](const Searched& other) {
      return other.kind == missing.effect.kind && other.unit == missing.unit;
    };
    auto found = std::ranges::find_if(kinds, same);
    if (found == kinds.end()) found = kinds.insert(kinds.end(), {missing.effect.kind, missing.unit, {}});
    found->places.push_back(&missing);
  }
  std::ranges::stable_sort(kinds, {}, rank);
  return kinds;
}

std::string place(const NotFound& missing, const Robot& robot) {
  const EffectEntry effect = effect_entry(missing.effect, robot);
  const std::string where = effect.joint ? fmt::format("joint {}", *effect.joint) : "whole arm";
  const std::string which = effect.telling();
  return which.empty() ? where : where + ", " + which;
}

std::string limit(const NotFound& missing) {
  return limit_amount(missing.smallest_detectable, missing.unit);
}

bool was_added(const LoopOutcome& loop, const std::string& kind) {
  return std::ranges::any_of(loop.rounds, [&kind](const Round& round) {
    return round.verdict == Verdict::added && round.effect.kind == kind;
  });
}

std::string words_of(const Searched& searched, const Robot& robot) {
  const auto [least, most] = std::ranges::minmax_element(
      searched.places, {}, [](const NotFound* missing) { return missing->smallest_detectable; });
  if (searched.places.size() == 1) return place(**least, robot) + " below " + limit(**least);
  return fmt::format("below {} ({}) to {} ({})", limit(**least), place(**least, robot), limit(**most),
                     place(**most, robot));
}

}  // namespace

std::string not_found_lines(const LoopOutcome& loop, const Robot& described) {
  const std::vector<Searched> kinds = by_kind(loop.not_found);
  std::string text;
  std::size_t told = 0;
  for (std::size_t i = 0; i < std::min(kMostKinds, kinds.size()); ++i) {
    text += wrapped((was_added(loop, kinds[i].kind) ? "  no other " : "  no ") + kinds[i].kind + ":",
                    words_of(kinds[i], described), 4);
    told += kinds[i].places.size();
  }
  const auto testable = static_cast<std::size_t>(std::ranges::count_if(loop.not_found, &NotFound::testable));
  if (told < testable) {
    text += fmt::format("  {} more effects not found, with their limits: see report.html\n", testable - told);
  }
  return text;
}

std::string untestable_line(const LoopOutcome& loop) {
  std::vector<std::pair<std::string, std::string>> kinds;  // and joints
  for (const NotFound& missing : loop.not_found) {
    if (missing.testable) continue;
    const std::string& kind = missing.effect.kind;
    auto found = std::ranges::find(kinds, kind, &std::pair<std::string, std::string>::first);
    if (found == kinds.end()) found = kinds.insert(kinds.end(), {kind, ""});
    if (missing.effect.joint >= 0)
      found->second += fmt::format("{}{}", found->second.empty() ? "" : ", ", missing.effect.joint + 1);
  }
  std::string text;
  for (const auto& [kind, joints] : kinds) {
    text += (text.empty() ? "" : "; ") + kind + (joints.empty() ? "" : " of joint ") + joints;
  }
  const char* why = " (only implausibly large ones would show)";
  return text.empty() ? text : wrapped("  not testable with these data:", text + why, 4);
}

std::string unseen_line(const LoopOutcome& loop) {
  std::vector<std::pair<std::string, std::string>> reasons;  // and kinds
  for (const Unseen& unseen : loop.unseen) {
    const auto found = std::ranges::find(reasons, unseen.reason, &std::pair<std::string, std::string>::first);
    if (found == reasons.end()) {
      reasons.emplace_back(unseen.reason, unseen.kind);
    } else {
      found->second += ", " + unseen.kind;
    }
  }
  std::string text;
  for (const auto& [reason, kinds] : reasons) text += fmt::format("{}{} ({})", text.empty() ? "" : "; ", kinds, reason);
  return text.empty() ? text : wrapped("  not testable with these data:", text, 4);
}

std::string noise_line(const LoopOutcome& loop) {
  const NoiseModel& noise = loop.noise;
  const double independent_mm = millimetres(loop.independent_m);
  if (loop.stopped != StopReason::not_run && !loop.noise_estimated) {
    return wrapped("  noise:",
                   fmt::format("{:.3f} mm an axis, taken to be independent from pose to pose: what poses share was not "
                               "estimated",
                               independent_mm),
                   4);
  }
  std::vector<std::string> parts;
  if (noise.joint_rad > 0.0) parts.push_back(fmt::format("joints repeat to {:.3f} mrad", 1e3 * noise.joint_rad));
  if (noise.repeats > 0.0)
    parts.push_back(fmt::format("repeats of a pose share {:.3f} mm", independent_mm * noise.repeats));
  if (noise.order > 0.0) {
    parts.push_back(
        fmt::format("poses measured one after another share {:.3f} mm (correlation {:.2f}): errors of poses "
                    "measured between others look smaller than they are",
                    independent_mm * noise.order, noise.correlation));
  }
  if (parts.empty()) return {};
  return wrapped("  noise:", fmt::format("{:.3f} mm an axis, independent; {}", independent_mm, fmt::join(parts, "; ")),
                 4);
}

std::string decoys_line(const LoopOutcome& loop) {
  if (loop.decoys.empty()) return {};
  std::string winners;
  for (const Decoy& decoy : loop.decoys) {
    if (decoy.won) winners += (winners.empty() ? "" : "; ") + decoy.name;
  }
  constexpr double kRare = 0.05;
  const Decoy& rarest = *std::ranges::min_element(loop.decoys, {}, &Decoy::p_left);
  if (winners.empty() && rarest.p_left <= kRare) {
    return wrapped(
        "  controls:",
        fmt::format("{}, which cannot exist, explains more than noise should (p = {:.3f}): the noise is not what "
                    "it was taken for, and none of the effects is sure",
                    rarest.name, rarest.p_left),
        4);
  }
  if (!winners.empty()) return wrapped("  controls: WON by what cannot be true:", winners, 4);
  const Decoy& best = *std::ranges::max_element(loop.decoys, {}, &Decoy::best_fall_nats);
  return wrapped("  controls:",
                 fmt::format("none of {} decoys won; the best, {}, fell by {:.1f} nats", loop.decoys.size(), best.name,
                             best.best_fall_nats),
                 4);
}

}  // namespace demecal
