#include "explanations/causes.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <ranges>
#include <string>
#include <string_view>
#include <vector>

#include "effects/effect.hpp"
#include "errors/check.hpp"

namespace demecal::inline explanations {
namespace {

struct GroupWords {
  CauseGroup group;
  std::string_view word;      ///< in files
  std::string_view of_joint;  ///< " of joint 2" follows
  std::string_view of_arm;    ///< where it is of no joint; empty: it always is
  std::string_view advice;
};

constexpr std::array<GroupWords, 12> kGroups{{
    {CauseGroup::transmission, "transmission", "gears", "",
     "Corrected targets compensate it. Where it is more than the gear's maker states as running error, have its "
     "mounting "
     "and wear checked."},
    {CauseGroup::encoder, "encoder", "encoder", "",
     "Have the joint's encoder or resolver, and how it is mounted, checked. Corrected targets compensate it, except "
     "close to a jump: which side of it a joint stops at is not known there."},
    {CauseGroup::lost_motion, "lost_motion", "lost motion", "",
     "Approach targets from the side they were measured from, or correct programs with their approach known. Where it "
     "grows, have the play of the gear and the brake checked."},
    {CauseGroup::elasticity, "elasticity", "elasticity", "elasticity of the arm under gravity",
     "Corrected targets compensate it for the payload that was measured. With another payload, state it, or measure "
     "again with it."},
    {CauseGroup::balance_spring, "balance_spring", "balance spring", "",
     "Corrected targets compensate it. Where it grows, have the tension of its spring, or the pressure of its gas, "
     "checked against what the maker states."},
    {CauseGroup::bearing, "bearing", "bearing", "",
     "Corrected targets compensate it. Where it grows, have the bearing's preload checked."},
    {CauseGroup::link_geometry, "link_geometry", "geometry of the link", "",
     "Declare the geometry, so that all links are fitted together."},
    {CauseGroup::zero, "zero", "zero", "",
     "Master the joint again, or declare the joint offsets, so that all are fitted together."},
    {CauseGroup::tool, "tool_point", "tool point", "tool point",
     "Teach the tool point again, or declare the tool, so that it is fitted with all else."},
    {CauseGroup::heat, "heat", "temperature", "temperature of the arm",
     "Let the robot warm up before it works, or state its temperature when programs are corrected."},
    {CauseGroup::instrument, "instrument", "instrument", "instrument or its mounting",
     "Not the robot's: check the instrument's scale against a known length and how firmly both stand, and measure "
     "again. Targets are not to be corrected by it."},
    {CauseGroup::formula, "formula", "error outside the catalogue", "error outside the catalogue",
     "Corrected targets compensate it within the measured range. Look at what the formula depends on before you trust "
     "it "
     "elsewhere."},
}};

const GroupWords& group_words(CauseGroup group) {
  const auto found = std::ranges::find(kGroups, group, &GroupWords::group);
  DEMECAL_CHECK(found != kGroups.end(), "cause group " << static_cast<int>(group));
  return *found;
}

/// One text after another, no sentence twice.
std::string joined_sentences(const std::vector<std::string_view>& texts) {
  constexpr std::string_view kBetween = ". ";
  std::vector<std::string_view> said;
  std::string text;
  for (std::string_view left : texts) {
    while (!left.empty()) {
      const std::size_t end = left.find(kBetween);
      const std::string_view sentence = left.substr(0, end == std::string_view::npos ? end : end + 1);
      left.remove_prefix(end == std::string_view::npos ? left.size() : end + kBetween.size());
      if (std::ranges::find(said, sentence) != said.end()) continue;
      said.push_back(sentence);
      text += (text.empty() ? "" : " ") + std::string(sentence);
    }
  }
  return text;
}

/// Whether causes of the group are the whole arm's, whichever joint an effect is of.
bool is_of_arm(CauseGroup group) {
  return group == CauseGroup::elasticity || group == CauseGroup::heat || group == CauseGroup::instrument;
}

}  // namespace

ErrorCause cause_at(std::string_view kind, int joint) {
  const CauseGroup group = cause_of(kind).group;
  return {group, is_of_arm(group) ? -1 : joint};
}

std::vector<ErrorCause> causes_of(const CorrectedRobot& robot) {
  std::vector<ErrorCause> causes;
  for (std::size_t i = 0; i < robot.effects.size(); ++i) {
    const ErrorCause at = cause_at(robot.effects[i].kind, robot.effects[i].joint);
    auto cause = std::ranges::find_if(causes, [&](const ErrorCause& one) { return one.is_same_as(at); });
    if (cause == causes.end()) cause = causes.insert(cause, at);
    cause->effects.push_back(i);
  }
  return causes;
}

std::string_view to_string(CauseGroup group) {
  return group_words(group).word;
}

std::string to_string(const ErrorCause& cause) {
  const GroupWords& words = group_words(cause.group);
  if (cause.joint < 0) return std::string(words.of_arm.empty() ? words.of_joint : words.of_arm);
  return std::string(words.of_joint) + " of joint " + std::to_string(cause.joint + 1);
}

std::string advice_on(const ErrorCause& cause, const CorrectedRobot& robot) {
  const auto is_reversed = [&](std::size_t i) { return !law_of(robot.effects[i]).reversal(robot.effects[i]).empty(); };
  const bool reversed = !cause.effects.empty() && std::ranges::all_of(cause.effects, is_reversed);
  std::vector<std::string_view> all;
  for (const std::size_t i : cause.effects) {
    const EffectLaw& law = law_of(robot.effects[i]);
    std::string_view one = reversed ? law.reversal(robot.effects[i]) : law.advice(robot.effects[i]);
    if (one.empty()) one = group_words(cause.group).advice;
    if (std::ranges::find(all, one) == all.end()) all.push_back(one);
  }
  if (all.empty()) return std::string(group_words(cause.group).advice);
  return joined_sentences(all);
}

}  // namespace demecal::inline explanations
