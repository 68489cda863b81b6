#include <fmt/format.h>

#include <algorithm>

#include "effects/catalogue.hpp"
#include "report/wording.hpp"
#include "terminal/loop_text.hpp"
#include "terminal/text.hpp"

namespace demecal {
namespace {

constexpr std::size_t kMostKinds = 5;

/// Places searched for one kind of effect in one unit.
struct Searched {
  std::string kind, unit;
  std::vector<const NotFoundEntry*> places;
};

int rank(const Searched& searched) {
  return place_among_limits(searched.kind);
}

std::vector<Searched> by_kind(const std::vector<NotFoundEntry>& not_found) {
  std::vector<Searched> kinds;
  for (const NotFoundEntry& missing : not_found) {
    if (!missing.smallest_detectable) continue;
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

std::string place(const NotFoundEntry& missing) {
  const std::string where = missing.effect.joint ? fmt::format("joint {}", *missing.effect.joint) : "whole arm";
  const std::string which = missing.effect.telling();
  return which.empty() ? where : where + ", " + which;
}

std::string limit(const NotFoundEntry& missing) {
  return limit_amount(*missing.smallest_detectable, missing.unit);
}

bool was_added(const Report& report, const std::string& kind) {
  return std::ranges::any_of(report.rounds,
                             [&kind](const RoundEntry& round) { return round.added() && round.effect.kind == kind; });
}

std::string limits_of(const Searched& searched) {
  const auto [least, most] = std::ranges::minmax_element(
      searched.places, {}, [](const NotFoundEntry* missing) { return *missing->smallest_detectable; });
  if (searched.places.size() == 1) return place(**least) + " below " + limit(**least);
  return fmt::format("below {} ({}) to {} ({})", limit(**least), place(**least), limit(**most), place(**most));
}

std::string not_found_lines(const Report& report) {
  const std::vector<Searched> kinds = by_kind(report.not_found);
  std::string text;
  std::size_t told = 0;
  for (std::size_t i = 0; i < std::min(kMostKinds, kinds.size()); ++i) {
    text += wrapped((was_added(report, kinds[i].kind) ? "  no other " : "  no ") + kinds[i].kind + ":",
                    limits_of(kinds[i]), 4);
    told += kinds[i].places.size();
  }
  const auto testable = static_cast<std::size_t>(std::ranges::count_if(report.not_found, &NotFoundEntry::testable));
  if (told < testable) {
    text += fmt::format("  {} more effects not found, with their limits: see report.html\n", testable - told);
  }
  return text;
}

using TextByText = std::vector<std::pair<std::string, std::string>>;

/// The text under that key, which is empty where it is new.
std::string& text_under(TextByText& texts, const std::string& key) {
  auto found = std::ranges::find(texts, key, &TextByText::value_type::first);
  if (found == texts.end()) found = texts.insert(texts.end(), {key, ""});
  return found->second;
}

/// One paragraph of effects that only an implausible size would show.
std::string untestable_line(const Report& report) {
  TextByText kinds;  // and joints
  for (const NotFoundEntry& missing : report.not_found) {
    if (missing.testable()) continue;
    std::string& joints = text_under(kinds, missing.effect.kind);
    if (missing.effect.joint) joints += fmt::format("{}{}", joints.empty() ? "" : ", ", *missing.effect.joint);
  }
  std::string text;
  for (const auto& [kind, joints] : kinds) {
    text += (text.empty() ? "" : "; ") + kind + (joints.empty() ? "" : " of joint ") + joints;
  }
  const char* why = " (only implausibly large ones would show)";
  return text.empty() ? text : wrapped("  not testable with these data:", text + why, 4);
}

/// One paragraph of the kinds that these data cannot show, by reason.
std::string unseen_line(const Report& report) {
  TextByText reasons;  // and kinds
  for (const UnseenEntry& unseen : report.unseen) {
    std::string& kinds = text_under(reasons, unseen.reason);
    kinds += (kinds.empty() ? "" : ", ") + unseen.kind;
  }
  std::string text;
  for (const auto& [reason, kinds] : reasons) text += fmt::format("{}{} ({})", text.empty() ? "" : "; ", kinds, reason);
  return text.empty() ? text : wrapped("  not testable with these data:", text, 4);
}

/// How measurements scatter together; nothing where all poses are independent.
std::string noise_line(const NoiseEntry& noise) {
  const double independent_mm = noise.independent_mm.value_or(0.0);
  if (!noise.estimated) {
    return wrapped("  noise:",
                   fmt::format("{:.3f} mm an axis, taken to be independent from pose to pose: what poses share was not "
                               "estimated",
                               independent_mm),
                   4);
  }
  std::vector<std::string> parts;
  if (noise.joint_repeatability_mrad > 0.0)
    parts.push_back(fmt::format("joints repeat to {:.3f} mrad", *noise.joint_repeatability_mrad));
  if (noise.shared_by_repeats_mm > 0.0)
    parts.push_back(fmt::format("repeats of a pose share {:.3f} mm", *noise.shared_by_repeats_mm));
  if (noise.shared_in_order_mm > 0.0) {
    parts.push_back(
        fmt::format("poses measured one after another share {:.3f} mm (correlation {:.2f}): errors of poses measured "
                    "between others "
                    "look smaller than they are",
                    *noise.shared_in_order_mm, noise.correlation_in_order.value_or(0.0)));
  }
  if (parts.empty()) return {};
  return wrapped("  noise:", fmt::format("{:.3f} mm an axis, independent; {}", independent_mm, fmt::join(parts, "; ")),
                 4);
}

/// Whether a decoy won, or explains more than noise should.
std::string decoys_line(const Report& report) {
  const std::vector<DecoyEntry>& decoys = report.decoys;
  if (decoys.empty()) return {};
  std::string winners;
  for (const DecoyEntry& decoy : decoys) {
    if (decoy.won) winners += (winners.empty() ? "" : "; ") + decoy.name;
  }
  if (!winners.empty()) return wrapped("  controls: WON by what cannot be true:", winners, 4);
  constexpr double kRare = 0.05;
  const DecoyEntry& rarest =
      *std::ranges::min_element(decoys, {}, [](const DecoyEntry& decoy) { return decoy.p_left.value_or(1.0); });
  if (rarest.p_left.value_or(1.0) <= kRare) {
    return wrapped(
        "  controls:",
        fmt::format("{}, which cannot exist, explains more than noise should (p = {:.3f}): the noise is not what "
                    "it was taken for, and none of the effects is sure",
                    rarest.name, *rarest.p_left),
        4);
  }
  const DecoyEntry& best = *std::ranges::max_element(decoys, {}, &DecoyEntry::best_fall_nats);
  return wrapped("  controls:", fmt::format("none of {} decoys won; the best was {}", decoys.size(), best.name), 4);
}

}  // namespace

std::string limits_to_terminal(const Report& report) {
  return not_found_lines(report) + untestable_line(report) + unseen_line(report) +
         (report.noise ? noise_line(*report.noise) : "") + decoys_line(report);
}

}  // namespace demecal
