#include "diagnosis/candidates.hpp"

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <map>
#include <optional>
#include <string_view>
#include <utility>

#include "effects/weight_parts.hpp"
#include "expression/bound.hpp"
#include "kinematics/chain.hpp"

namespace demecal::inline diagnosis {
namespace {

bool is_wanted(const std::vector<std::string>& kinds, std::string_view kind) {
  return kinds.empty() || std::find(kinds.begin(), kinds.end(), kind) != kinds.end();
}

/// Whether a declared correction of the joint holds the effect already: a smooth function of that joint alone.
bool is_in_correction(const Effect& effect, const Robot& robot, const DeclaredModel& declared) {
  if (!declared.joint_corrections || effect.joint < 0) return false;
  if (!is_revolute(robot.chain, effect.joint)) return false;
  return law_of(effect).is_smooth(effect);
}

/// Decoys of the first candidate of every kind and joint that has one.
std::vector<Candidate> decoys_of(const std::vector<Candidate>& candidates, const Evidence& evidence) {
  std::vector<Candidate> decoys;
  for (const Candidate& candidate : candidates) {
    const Effect& effect = candidate.effect;
    const bool has_one =
        !decoys.empty() && decoys.back().effect.kind == effect.kind && decoys.back().effect.joint == effect.joint;
    if (has_one) continue;
    const std::optional<DecoyEffect> decoy = law_of(effect).decoy(effect, evidence);
    if (!decoy) continue;
    decoys.push_back(candidate);
    decoys.back().effect = decoy->effect;
    decoys.back().decoy_kind = decoy->kind;
  }
  return decoys;
}

constexpr double kVaried = 1e-9;

struct RecordedRange {
  bool everywhere = true;
  double lower = std::numeric_limits<double>::infinity();
  double upper = -std::numeric_limits<double>::infinity();
  double sum = 0.0;

  void take(const std::optional<double>& value) {
    if (!value) {
      everywhere = false;
      return;
    }
    lower = std::min(lower, *value);
    upper = std::max(upper, *value);
    sum += *value;
  }
  bool varied() const { return everywhere && upper - lower > kVaried; }
};

bool came_from_both_sides(const DataSet& data, std::span<const std::size_t> poses) {
  std::vector<bool> up(data.robot.chain.joints.size()), down(up.size());
  for (const std::size_t pose : poses) {
    if (!data.poses[pose].approach) continue;
    for (std::size_t i = 0; i < up.size(); ++i) {
      const double sign = (*data.poses[pose].approach)[static_cast<Eigen::Index>(i)];
      up[i] = up[i] || sign > 0;
      down[i] = down[i] || sign < 0;
    }
  }
  for (std::size_t i = 0; i < up.size(); ++i) {
    if (up[i] && down[i]) return true;
  }
  return false;
}

/// One per joint; nothing where torques were not logged.
std::vector<std::map<std::string, double>> logged_weights_of(const DataSet& data, std::span<const std::size_t> poses) {
  std::vector<std::map<std::string, double>> weights;
  const auto logged = [&](std::size_t pose) { return data.poses[pose].torque.has_value(); };
  if (!std::ranges::all_of(poses, logged)) return weights;
  std::vector<ArmState> states;
  for (const std::size_t pose : poses) states.push_back(arm_state(data.robot, Stop(data.poses[pose])));
  for (int joint = 0; joint < data.robot.chain.size(); ++joint) {
    weights.push_back(logged_weights(data.robot, states, joint));
  }
  return weights;
}

}  // namespace

std::vector<bool> candidates_among(const std::vector<Candidate>& candidates, std::span<const Effect> effects) {
  std::vector<bool> among;
  for (const Candidate& candidate : candidates) {
    const auto is_it = [&](const Effect& effect) { return effect.same_law_as(candidate.effect); };
    among.push_back(candidate.decoy_kind == DecoyKind::none && std::ranges::any_of(effects, is_it));
  }
  return among;
}

double naming_cost_nats(const Effect& effect, const std::vector<Candidate>& candidates) {
  const auto same = std::find_if(candidates.begin(), candidates.end(),
                                 [&](const Candidate& candidate) { return candidate.effect.same_law_as(effect); });
  return same == candidates.end() ? 0.0 : same->naming_cost_nats;
}

void set_measured_ranges(Effect& effect, const Robot& robot, const Evidence& evidence) {
  for (const int joint : law_of(effect).ranged_joints(effect, robot)) {
    effect.ranges[joint] = evidence.joint_ranges[static_cast<std::size_t>(joint)];
  }
}

std::vector<Candidate> candidates_for(const Robot& robot, const Evidence& evidence, const DeclaredModel& declared,
                                      const CandidateOptions& options) {
  std::vector<Candidate> candidates;
  for (const EffectLaw* law : catalogue()) {
    if (!is_wanted(options.kinds, law->kind()) || declared.holds(law->kind())) continue;
    if (law->is_last_resort() != options.last_resort) continue;
    const bool symbolic = law->takes_formula();
    std::vector<Effect> proposals =
        symbolic && options.formulas ? formula_library(robot, evidence) : law->proposals(robot, evidence);
    std::map<std::string, int> alike;  // of one form each, so that a law does not grow dear by its further forms
    for (const Effect& effect : proposals) ++alike[effect.form];
    for (Effect& effect : proposals) {
      const double nats = std::log(alike[effect.form]) + (symbolic ? kOutsideCatalogue_nats : 0.0);
      if (is_in_correction(effect, robot, declared)) continue;
      set_measured_ranges(effect, robot, evidence);
      candidates.push_back({std::move(effect), DecoyKind::none, nats});
    }
  }
  if (!options.decoys) return candidates;
  std::vector<Candidate> decoys = decoys_of(candidates, evidence);
  std::ranges::move(decoys, std::back_inserter(candidates));
  return candidates;
}

std::vector<ArmState> with_shuffled(const std::vector<ArmState>& states, DecoyKind decoy_kind, RandomStream random) {
  std::vector<ArmState> changed = states;
  std::vector<std::size_t> from(states.size());
  for (std::size_t i = 0; i < from.size(); ++i) from[i] = i;
  for (std::size_t i = from.size(); i > 1; --i) std::swap(from[i - 1], from[random.index(i)]);
  for (std::size_t i = 0; i < from.size(); ++i) {
    const Stop& other = states[from[i]].stop;
    if (decoy_kind == DecoyKind::shuffled_approach) changed[i].stop.approach = other.approach;
    if (decoy_kind == DecoyKind::shuffled_temperature) changed[i].stop.temperature_celsius = other.temperature_celsius;
  }
  return changed;
}

std::vector<SampledEffect> sampled_effects(const std::vector<Candidate>& candidates,
                                           const std::vector<ArmState>& states, const DecoyStates& of_decoys) {
  std::vector<SampledEffect> sampled;
  for (const Candidate& candidate : candidates) {
    const DecoyKind kind = candidate.decoy_kind;
    const bool sides = kind == DecoyKind::shuffled_approach, heat = kind == DecoyKind::shuffled_temperature;
    sampled.push_back({candidate.effect, sides ? of_decoys.sides : heat ? of_decoys.heat : states});
  }
  return sampled;
}

std::string decoy_name(const Candidate& candidate) {
  std::string name = candidate.effect.kind + " of joint " + std::to_string(candidate.effect.joint + 1);
  switch (candidate.decoy_kind) {
    case DecoyKind::wrong_ratio:
      return name + " at a ratio no gear has (" + std::to_string(candidate.effect.setting("ratio")) + ")";
    case DecoyKind::shuffled_approach:
      return name + " by shuffled approach signs";
    case DecoyKind::shuffled_temperature:
      return name + " by shuffled temperatures";
    case DecoyKind::none:
      break;
  }
  return name;
}

std::vector<double> naming_costs_nats(const std::vector<Candidate>& candidates) {
  std::vector<double> nats;
  for (const Candidate& candidate : candidates) nats.push_back(candidate.naming_cost_nats);
  return nats;
}

Evidence evidence_of(const DataSet& data, std::span<const std::size_t> poses) {
  Evidence evidence;
  RecordedRange payload, temperature, time;
  std::vector<RecordedRange> joints(data.robot.chain.joints.size());
  for (const std::size_t index : poses) {
    const MeasuredPose& pose = data.poses[index];
    payload.take(pose.payload_kg);
    temperature.take(pose.temperature_celsius);
    time.take(pose.time_s);
    evidence.orientation = evidence.orientation || pose.orientation.has_value();
    for (std::size_t i = 0; i < joints.size(); ++i) joints[i].take(pose.joints[static_cast<Eigen::Index>(i)]);
  }
  evidence.approach = came_from_both_sides(data, poses);
  evidence.payload = payload.varied();
  evidence.temperature = temperature.varied();
  evidence.time = time.varied();
  evidence.masses = !data.robot.masses.empty();
  evidence.logged_weights = logged_weights_of(data, poses);
  for (const RecordedRange& joint : joints) evidence.joint_ranges.push_back({joint.lower, joint.upper});
  const auto count = static_cast<double>(poses.size());
  if (evidence.temperature) evidence.mean_temperature_celsius = temperature.sum / count;
  if (evidence.time) evidence.mean_time_s = time.sum / count;
  return evidence;
}

std::vector<UntestableKind> untestable_kinds(const Evidence& evidence, const std::vector<std::string>& kinds) {
  std::vector<UntestableKind> untestable;
  const auto add_lacking = [&](Circumstance circumstance, bool recorded, const char* reason) {
    if (recorded) return;
    for (const EffectLaw* law : catalogue()) {
      const bool wanted = kinds.empty() || std::find(kinds.begin(), kinds.end(), law->kind()) != kinds.end();
      if (wanted && law->prerequisite() == circumstance) untestable.push_back({std::string(law->kind()), reason});
    }
  };
  add_lacking(Circumstance::approach, evidence.approach,
              "no approach columns, or every joint always came from one side");
  add_lacking(Circumstance::temperature, evidence.temperature, "no temperature column, or one temperature only");
  add_lacking(Circumstance::time, evidence.time, "no time column");
  add_lacking(Circumstance::masses, evidence.masses, "no link masses in the robot's file");
  return untestable;
}

}  // namespace demecal::inline diagnosis
