#include "report/figures.hpp"
#include "report/pose_places.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <array>
#include <cctype>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <ranges>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "data/text.hpp"
#include "effects/catalogue.hpp"
#include "effects/effect.hpp"
#include "prediction/measurement.hpp"
#include "report/report.hpp"

namespace demecal::inline report {
namespace {

std::string kind_words(const std::string& kind) {
  return rarity(kind) < causes().size() ? std::string(cause_of(kind).words) : kind;
}

/// " of joints 2, 3 and 4".
std::string joints_words(const std::vector<std::uint64_t>& joints) {
  if (joints.empty()) return {};
  std::string text = joints.size() == 1 ? " of joint " : " of joints ";
  for (std::size_t i = 0; i < joints.size(); ++i) {
    const bool last = i + 1 == joints.size();
    text += (i == 0 ? "" : last ? " and " : ", ") + std::to_string(joints[i]);
  }
  return text;
}

/// The decoy that noise explains least often.
const DecoyEntry& rarest_decoy(const std::vector<DecoyEntry>& decoys) {
  return *std::ranges::min_element(decoys, {}, [](const DecoyEntry& decoy) { return decoy.p_left.value_or(1.0); });
}

bool is_rare(const DecoyEntry& decoy) {
  constexpr double kRare = 0.05;
  return decoy.p_left.value_or(1.0) <= kRare;
}

bool shared_in_order(const Report& report) {
  return report.noise && report.noise->shared_in_order_mm.value_or(0.0) > 0.0;
}

/// "joints, load and temperature": on which of these what is left was looked at; not `time` where that is not asked.
std::string dependences(const Report& report, bool time) {
  struct Dependence {
    std::string_view words;
    Circumstance circumstance;
  };
  constexpr std::array<Dependence, 5> kAll{{{"joints", Circumstance::none},
                                            {"load", Circumstance::masses},
                                            {"approach", Circumstance::approach},
                                            {"temperature", Circumstance::temperature},
                                            {"time", Circumstance::time}}};
  std::vector<std::string> words;
  for (const Dependence& one : kAll) {
    const auto lacks_it = [&](const UntestableEntry& unseen) {
      const EffectLaw* const law = find_law(unseen.kind);
      return law != nullptr && law->prerequisite() == one.circumstance;
    };
    if (one.circumstance == Circumstance::time && !time) continue;
    if (one.circumstance == Circumstance::none || std::ranges::none_of(report.untestable, lacks_it))
      words.emplace_back(one.words);
  }
  return listed_words(words, "or");
}

}  // namespace

std::string class_text(const std::vector<ClassMember>& members) {
  std::string text;
  const auto elsewhere = [&members](const ClassMember& member) { return member.joint != members.front().joint; };
  if (!members.empty() && members.front().joint && std::ranges::none_of(members, elsewhere)) {
    for (const ClassMember& member : members) text += (text.empty() ? "" : " or ") + kind_words(member.kind);
    return text + joints_words({*members.front().joint});
  }
  for (std::size_t i = 0; i < members.size();) {
    std::vector<std::uint64_t> joints;
    const std::string& kind = members[i].kind;
    for (; i < members.size() && members[i].kind == kind; ++i) {
      if (members[i].joint) joints.push_back(*members[i].joint);
    }
    text += (text.empty() ? "" : " or ") + kind_words(kind) + joints_words(joints);
  }
  return text;
}

std::string class_sentence(const std::vector<ClassMember>& members) {
  if (members.empty()) return {};
  std::string text = class_text(members) + ": these poses cannot tell.";
  text[0] = static_cast<char>(std::toupper(static_cast<unsigned char>(text[0])));
  return text;
}

std::string stop_sentence(const std::string& stopped) {
  if (stopped.empty() || stopped == "not_run") return {};
  if (stopped == "no_structure") return "The loop stopped because the error that is left shows no more structure.";
  if (stopped == "no_gain") return "The loop stopped because no further effect improved the validation poses.";
  if (stopped == "max_effects") return "The loop stopped at the largest number of effects it was allowed to add.";
  if (stopped == "decoy") {
    return "The loop stopped because a control, which cannot be true, explained the error better than every effect.";
  }
  return "The loop stopped: " + stopped + ".";
}

std::string statistics_sentences(const Report& report) {
  std::string text;
  const auto add = [&text](const std::string& sentence) { text += (text.empty() ? "" : " ") + sentence; };
  if (report.lack_of_fit_p) {
    add(fmt::format("Before the loop the error's excess over the repeats' own scatter had p = {}.",
                    probability(report.lack_of_fit_p)));
  }
  if (report.explained_share) {
    add(fmt::format("Of the mean square error beyond that scatter the effects explain {:.1f} %.",
                    100.0 * *report.explained_share));
  }
  if (report.structure_left_p) {
    constexpr double kDetected = 0.05;
    const std::string p = probability(report.structure_left_p);
    // What goes by the order of measuring was taken out before the test: it says nothing of time then.
    if (*report.structure_left_p <= kDetected)
      add(fmt::format("What is left still depends on {} (p = {}).", dependences(report, true), p));
    else if (shared_in_order(report))
      add(
          fmt::format("Beside the {:.3f} mm that goes by the order of measuring no remaining dependence on {} was "
                      "detected (p = {}).",
                      *report.noise->shared_in_order_mm, dependences(report, false), p));
    else
      add(fmt::format("No remaining dependence on {} was detected (p = {}).", dependences(report, true), p));
  }
  return text;
}

std::string station_noise_sentence(const std::vector<StationEntry>& stations) {
  std::vector<std::string> parts;
  for (const StationEntry& one : stations) {
    if (!one.noise_mm) continue;
    const std::string repeats = one.noise_floor_mm ? fmt::format(", its repeats by {:.3f}", *one.noise_floor_mm) : "";
    parts.push_back(fmt::format("{:.3f} mm ({}{})", *one.noise_mm, one.name, repeats));
  }
  if (parts.empty()) return {};
  return fmt::format(
      "Fitted poses scatter about the model by {} an axis; in the fit each station's poses weigh by their own scatter.",
      fmt::join(parts, ", "));
}

std::string noise_sentence(const NoiseEntry& noise) {
  const std::string independent = fmt::format("{:.3f} mm an axis", noise.independent_mm.value_or(0.0));
  if (!noise.estimated)
    return independent + ", taken to be independent from pose to pose: what poses share was not estimated";
  std::vector<std::string> parts;
  if (noise.joint_repeatability_mrad > 0.0)
    parts.push_back(
        fmt::format("joints repeat to {:.3f} mrad, or err by what was not tried", *noise.joint_repeatability_mrad));
  if (noise.shared_by_repeats_mm > 0.0)
    parts.push_back(fmt::format("repeats of a pose share {:.3f} mm", *noise.shared_by_repeats_mm));
  if (noise.shared_in_order_mm > 0.0) {
    parts.push_back(
        fmt::format("poses measured one after another share {:.3f} mm (correlation {:.2f}): errors of "
                    "poses measured between others look smaller than they are",
                    *noise.shared_in_order_mm, noise.correlation_in_order.value_or(0.0)));
  }
  if (parts.empty()) return independent + ", independent from pose to pose";
  return fmt::format("{}, independent; {}", independent, fmt::join(parts, "; "));
}

std::string decoys_sentence(const std::vector<DecoyEntry>& decoys) {
  if (decoys.empty()) return {};
  std::string winners;
  for (const DecoyEntry& decoy : decoys) {
    if (decoy.won) winners += (winners.empty() ? "" : "; ") + decoy.name;
  }
  if (!winners.empty()) return "WON by what cannot be true: " + winners;
  if (const DecoyEntry& rarest = rarest_decoy(decoys); is_rare(rarest)) {
    return fmt::format(
        "{}, which cannot exist, explains more than noise should (p = {:.3f}): the noise is not what it "
        "was taken for, and none of the effects is sure",
        rarest.name, *rarest.p_left);
  }
  const DecoyEntry& best = *std::ranges::max_element(decoys, {}, &DecoyEntry::best_gain_nats);
  return fmt::format("none of {} decoys won; the best was {}", decoys.size(), best.name);
}

std::string cause_name(const CauseEntry& cause) {
  std::string name = cause.name;
  for (const std::string& alternative : cause.alternatives) name += " or " + alternative;
  return cause.alternatives.empty() ? name : name + " (these poses cannot tell)";
}

std::string cost_sentence(const CauseEntry& cause) {
  std::string text = cause_name(cause);
  const bool harms = cause.without_mm && cause.with_mm && *cause.without_mm <= *cause.with_mm;
  if (harms) {
    text += fmt::format(": none of the error on these poses, {:.3f} mm without it and {:.3f} mm with it",
                        *cause.without_mm, *cause.with_mm);
  } else {
    text += fmt::format(": {:.3f} mm of the error", cause.cost_mm());
  }
  if (cause.interval_mm.size() == 2)
    text += harms ? fmt::format(" (95 %: up to {:.3f} mm of it)", cause.interval_mm[1])
                  : fmt::format(" (95 %: {:.3f} to {:.3f})", cause.interval_mm[0], cause.interval_mm[1]);
  return text;
}

std::string_view judging_set(const Report& report) {
  return report.poses.validation > 0 ? "validation" : "calibration";
}

std::string front_sentence(const Report& report) {
  constexpr std::uint64_t kFew = 10;
  const auto chosen = std::ranges::find(report.front, true, &FrontEntry::chosen);
  if (report.front.size() < 3 || chosen == report.front.end() || !chosen->validation_rms_mm) return {};
  std::string fewer, more;
  for (const FrontEntry& point : report.front) {
    if (point.chosen || !point.validation_rms_mm) continue;
    if (point.causes > chosen->causes) {
      more += fmt::format("{}{} {:.3f}", more.empty() ? "; with more: the best " : ", ", point.causes,
                          *point.validation_rms_mm);
    } else if (point.causes <= kFew) {
      const std::string causes = point.causes == 0 ? "none" : "the best " + std::to_string(point.causes);
      fewer += fmt::format("{}{} {:.3f}", fewer.empty() ? "; with fewer (to first order): " : ", ", causes,
                           *point.validation_rms_mm);
    }
  }
  const bool errs_more = std::ranges::any_of(report.front, [&](const FrontEntry& point) {
    return point.causes < chosen->causes && point.validation_rms_mm < chosen->validation_rms_mm;
  });
  return fmt::format("Left on {} poses (rms, mm) with the model's {} cause{} {:.3f}{}{}.{}", judging_set(report),
                     chosen->causes, chosen->causes == 1 ? "" : "s", *chosen->validation_rms_mm, fewer, more,
                     errs_more
                         ? " That fewer leave less here is no reason to leave one out: the calibration poses show "
                           "each, and so small a difference on these may be chance."
                         : "");
}

std::string outliers_sentence(const Report& report) {
  std::string text;
  for (const ReportPoseSet& set : kPoseSets) {
    std::vector<double> all_mm, kept_mm;
    for (const PoseErrorEntry& pose : report.pose_errors) {
      if (pose.set != set.name || !pose.after_mm) continue;
      all_mm.push_back(*pose.after_mm);
      if (std::ranges::find(pose.flags, "outlier") == pose.flags.end()) kept_mm.push_back(*pose.after_mm);
    }
    const std::size_t left_out = all_mm.size() - kept_mm.size();
    if (left_out == 0 || kept_mm.empty()) continue;
    text += fmt::format("{}{:.3f} mm instead of {:.3f} mm on {} poses ({} left out)", text.empty() ? "" : ", ",
                        error_figures(std::move(kept_mm)).rms_mm, error_figures(std::move(all_mm)).rms_mm, set.name,
                        left_out);
  }
  return text.empty() ? text : "Without suspected outliers the rms error is " + text + ".";
}

namespace {

std::string decoy_doubt(const Report& report) {
  if (report.decoys.empty()) return {};
  const auto winner = std::ranges::find_if(report.decoys, &DecoyEntry::won);
  const bool won = winner != report.decoys.end();
  const DecoyEntry& decoy = won ? *winner : rarest_decoy(report.decoys);
  if (!won && !is_rare(decoy)) return {};
  return fmt::format(
      "None of the effects is sure: {}, which cannot exist, explains {} (see controls). The noise is not what it was "
      "taken for. Before you act on them, measure again, with the poses in random order.",
      decoy.name, won ? "the error better than any real effect" : "more than noise should");
}

}  // namespace

std::string doubt_sentence(const Report& report) {
  if (!report.added_any()) return {};
  std::string text = decoy_doubt(report);
  const auto add = [&text](const std::string& sentence) { text += (text.empty() ? "" : " ") + sentence; };
  if (!report.considered.empty())
    add(fmt::format("Nothing but {} was looked for: other causes may explain the same.",
                    listed_words(report.considered, "and")));
  if (report.poses.validation == 0)
    add("There were no validation poses: nothing that the fit did not see confirms the effects.");
  return text;
}

}  // namespace demecal::inline report
