#include <fmt/format.h>
#include <algorithm>
#include <cstddef>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "effects/catalogue.hpp"
#include "report/figures.hpp"
#include "report/report.hpp"
#include "terminal/report_text.hpp"
#include "terminal/text.hpp"

namespace demecal::inline terminal {
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

std::string searched_place(const NotFoundEntry& missing) {
  const std::string where = missing.effect.joint ? fmt::format("joint {}", *missing.effect.joint) : "whole arm";
  const std::string which = missing.effect.distinction();
  return which.empty() ? where : where + ", " + which;
}

std::string limit(const NotFoundEntry& missing) {
  return limit_amount(*missing.smallest_detectable, missing.unit);
}

bool was_added(const Report& report, const std::string& kind) {
  return std::ranges::any_of(report.rounds,
                             [&kind](const RoundEntry& round) { return round.added() && round.effect.kind == kind; });
}

/// Their limit is that of the turn under a weight that pulls straight across the axis.
bool of_unknown_masses(const NotFoundEntry* missing) {
  return missing->effect.form == "moments";
}

std::string limits_of(const Searched& searched) {
  const auto [least, most] = std::ranges::minmax_element(
      searched.places, {}, [](const NotFoundEntry* missing) { return *missing->smallest_detectable; });
  const char* const note = std::ranges::any_of(searched.places, of_unknown_masses)
                               ? "; moments: with the whole lever of the weight, of which these poses have a part"
                               : "";
  if (searched.places.size() == 1) return searched_place(**least) + " below " + limit(**least) + note;
  const auto [from, to] = limit_amounts(*(*least)->smallest_detectable, *(*most)->smallest_detectable, searched.unit);
  return fmt::format("below {} ({}) to {} ({}){}", from, searched_place(**least), to, searched_place(**most), note);
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
  for (const UntestableEntry& unseen : report.untestable) {
    std::string& kinds = text_under(reasons, unseen.reason);
    kinds += (kinds.empty() ? "" : ", ") + unseen.kind;
  }
  std::string text;
  for (const auto& [reason, kinds] : reasons) text += fmt::format("{}{} ({})", text.empty() ? "" : "; ", kinds, reason);
  return text.empty() ? text : wrapped("  not testable with these data:", text, 4);
}

std::string decoys_line(const Report& report) {
  const std::string sentence = decoys_sentence(report.decoys);
  return sentence.empty() ? "" : wrapped("  controls:", sentence, 4);
}

}  // namespace

std::string limits_to_terminal(const Report& report) {
  return not_found_lines(report) + untestable_line(report) + unseen_line(report) +
         (report.noise ? wrapped("  noise:", noise_sentence(*report.noise), 4) : "") + decoys_line(report);
}

}  // namespace demecal::inline terminal
