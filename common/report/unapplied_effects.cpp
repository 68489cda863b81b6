#include "report/unapplied_effects.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace demecal {
namespace {

/// A circumstance that an effect may need, and whether a pose has it.
struct Circumstance {
  const char* name;
  const char* words;    ///< what a pose without it has not
  const char* instead;  ///< what the model takes there
  bool Needs::*needed;
  bool (*has)(const MeasuredPose&);
};

constexpr Circumstance kCircumstances[] = {
    {"approach", "approach direction", "no side", &Needs::approach,
     [](const MeasuredPose& pose) { return pose.approach.has_value(); }},
    {"payload", "payload", "an empty hand", &Needs::payload,
     [](const MeasuredPose& pose) { return pose.payload_kg.has_value(); }},
    {"temperature", "temperature", "the effect's reference", &Needs::temperature,
     [](const MeasuredPose& pose) { return pose.temperature_celsius.has_value(); }},
    {"time", "time", "the effect's reference", &Needs::time,
     [](const MeasuredPose& pose) { return pose.time_s.has_value(); }}};

const Circumstance& circumstance(const std::string& name) {
  return *std::ranges::find_if(kCircumstances, [&name](const Circumstance& one) { return one.name == name; });
}

}  // namespace

std::string UnappliedEffect::sentence() const {
  const Circumstance& lack = circumstance(lacking);
  return fmt::format("{}{} cannot be applied as it was calibrated at {} of {} poses: they have no {}, and {} is taken",
                     kind, joint < 0 ? "" : fmt::format(" of joint {}", joint + 1), poses, of_all, lack.words,
                     lack.instead);
}

std::vector<UnappliedEffect> unapplied_effects(const CorrectedRobot& robot, const DataSet& data) {
  std::vector<UnappliedEffect> all;
  for (const Effect& effect : robot.effects) {
    const Needs needs = law_of(effect).needs(effect, data.robot);
    for (const Circumstance& one : kCircumstances) {
      if (!(needs.*one.needed)) continue;
      const auto without = static_cast<std::size_t>(
          std::ranges::count_if(data.poses, [&one](const MeasuredPose& pose) { return !one.has(pose); }));
      if (without > 0) all.push_back({effect.kind, effect.joint, one.name, without, data.poses.size()});
    }
  }
  return all;
}

}  // namespace demecal
