// Effects of every law, with random coefficients of the size that real arms have, and stops at which they show.
#pragma once

#include <algorithm>
#include <cmath>

#include "expression/text.hpp"
#include "prediction/corrected_robot.hpp"
#include "random_robot.hpp"

namespace demecal {

/// The arm with links that weigh something.
inline Robot heavy(RandomStream& stream, const Chain& chain) {
  Robot robot;
  robot.chain = chain;
  for (int i = 0; i < chain.size(); ++i) {
    robot.masses.push_back({stream.real(2, 20), {stream.real(-0.2, 0.2), stream.real(-0.2, 0.2), stream.real(0, 0.2)}});
  }
  return robot;
}

/// A stop anywhere, reached from any side, with any load, at any time and warmth.
inline Stop random_stop(RandomStream& stream, const Chain& chain) {
  Stop stop(random_joints(stream, chain));
  stop.approach.resize(chain.size());
  for (double& sign : stop.approach) sign = stream.chance(0.5) ? 1.0 : -1.0;
  stop.payload_kg = stream.real(0, 8);
  stop.temperature_celsius = stream.real(15, 35);
  stop.time_s = stream.real(0, 3600);
  return stop;
}

/// Data that hold everything any effect needs.
inline Evidence all_evidence(const Chain& chain, bool masses) {
  Evidence evidence{.approach = true, .payload = true, .temperature = true, .time = true, .masses = masses};
  evidence.orientation = true;
  evidence.highest_ratio = 20;
  for (const Joint& joint : chain.joints) evidence.joint_ranges.push_back({joint.lower, joint.upper});
  const std::string last = "logged_" + std::to_string(chain.size());
  evidence.logged_weights.assign(
      chain.joints.size(),
      {{"logged_friction", 1.0}, {"logged_zero", -0.5}, {last + "_mx", 30.0}, {last + "_mass", 80.0}});
  return evidence;
}

/// All that the catalogue proposes for the arm, and effects outside it.
inline std::vector<Effect> all_proposals(const Robot& robot) {
  std::vector<Effect> effects;
  for (const bool masses : {false, true}) {
    for (const EffectLaw* law : catalogue()) {
      for (Effect& effect : law->proposals(robot, all_evidence(robot.chain, masses))) {
        const auto same = [&](const Effect& other) { return other.same_law_as(effect); };
        if (std::ranges::none_of(effects, same)) effects.push_back(std::move(effect));
      }
    }
  }
  Effect symbolic{.kind = "symbolic", .joint = 1, .settings = {{"reference_celsius", 21.0}}};
  symbolic.formula = parse("SIN(q2+2*q3)*s+0.01*T", symbolic_variables(robot.chain));
  effects.push_back(symbolic);
  symbolic.form = "wave";
  symbolic.formula = parse("q2-q3", symbolic_variables(robot.chain));
  effects.push_back(symbolic);
  return effects;
}

/// The effect with coefficients that move the arm by about `size` (m or rad) at most.
inline Effect of_size(Effect effect, const Robot& robot, RandomStream& stream, double size) {
  const std::size_t coefficients = law_of(effect).coefficients(effect, robot).size();
  std::vector<double> largest(coefficients, 0.0);
  for (int i = 0; i < 20; ++i) {
    ArmState state = arm_state(robot, random_stop(stream, robot.chain));
    state.tool_in_sensor_m = {1.0, 1.0, 1.0};
    std::vector<UnitMotion> motions;
    append_unit_motions(effect, robot, state, motions);
    for (const UnitMotion& motion : motions) {
      double& most = largest[static_cast<std::size_t>(motion.coefficient)];
      most = std::max(most, std::abs(motion.size));
    }
  }
  effect.values.clear();
  for (const double most : largest) effect.values.push_back(size * stream.real(-1, 1) / std::max(most, 1e-6));
  return effect;
}

/// Up to `of_each` random proposals of every kind.
inline std::vector<Effect> random_effects(const Robot& robot, RandomStream& stream, double size, int of_each) {
  std::map<std::string, std::vector<Effect>> by_kind;
  for (Effect& effect : all_proposals(robot)) by_kind[effect.kind].push_back(std::move(effect));
  std::vector<Effect> chosen;
  for (const auto& entry : by_kind) {
    const std::vector<Effect>& effects = entry.second;
    for (int i = 0; i < of_each; ++i) {
      const std::size_t which = stream.index(effects.size());
      const auto same = [&](const Effect& other) { return other.same_law_as(effects[which]); };
      if (std::ranges::none_of(chosen, same)) chosen.push_back(of_size(effects[which], robot, stream, size));
    }
  }
  return chosen;
}

}  // namespace demecal
