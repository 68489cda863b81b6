#include "diagnosis/candidates.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <map>

#include "diagnosis/formula_library.hpp"

namespace demecal {
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
    decoys.back().disguise = decoy->disguise;
  }
  return decoys;
}

}  // namespace

double price_nats(const Effect& effect, const std::vector<Candidate>& candidates) {
  const auto same = std::find_if(candidates.begin(), candidates.end(),
                                 [&](const Candidate& candidate) { return candidate.effect.same_law_as(effect); });
  return same == candidates.end() ? 0.0 : same->name_nats;
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
    const bool symbolic = law->takes_formula();
    std::vector<Effect> proposals =
        symbolic && options.formulas ? formula_library(robot, evidence) : law->proposals(robot, evidence);
    std::map<std::string, int> alike;  // of one form each, so that a law does not grow dear by its further forms
    for (const Effect& effect : proposals) ++alike[effect.form];
    for (Effect& effect : proposals) {
      const double nats = std::log(alike[effect.form]) + (symbolic ? kOutsideCatalogue_nats : 0.0);
      if (is_in_correction(effect, robot, declared)) continue;
      set_measured_ranges(effect, robot, evidence);
      candidates.push_back({std::move(effect), Disguise::none, nats});
    }
  }
  if (!options.decoys) return candidates;
  std::vector<Candidate> decoys = decoys_of(candidates, evidence);
  std::ranges::move(decoys, std::back_inserter(candidates));
  return candidates;
}

std::vector<ArmState> disguised(const std::vector<ArmState>& states, Disguise disguise, RandomStream random) {
  std::vector<ArmState> changed = states;
  std::vector<std::size_t> from(states.size());
  for (std::size_t i = 0; i < from.size(); ++i) from[i] = i;
  for (std::size_t i = from.size(); i > 1; --i) std::swap(from[i - 1], from[random.index(i)]);
  for (std::size_t i = 0; i < from.size(); ++i) {
    const Stop& other = states[from[i]].stop;
    if (disguise == Disguise::shuffled_approach) changed[i].stop.approach = other.approach;
    if (disguise == Disguise::shuffled_temperature) changed[i].stop.temperature_celsius = other.temperature_celsius;
  }
  return changed;
}

std::string decoy_name(const Candidate& candidate) {
  std::string name = candidate.effect.kind + " of joint " + std::to_string(candidate.effect.joint + 1);
  switch (candidate.disguise) {
    case Disguise::wrong_ratio:
      return name + " at a ratio no gear has (" + std::to_string(candidate.effect.setting("ratio")) + ")";
    case Disguise::shuffled_approach:
      return name + " by shuffled approach signs";
    case Disguise::shuffled_temperature:
      return name + " by shuffled temperatures";
    case Disguise::none:
      break;
  }
  return name;
}

std::vector<double> prices_nats(const std::vector<Candidate>& candidates) {
  std::vector<double> nats;
  for (const Candidate& candidate : candidates) nats.push_back(candidate.name_nats);
  return nats;
}

}  // namespace demecal
