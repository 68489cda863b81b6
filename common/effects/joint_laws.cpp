// What is wrong with a joint by its own drive or by another's: its zero, its gain, coupling, and jumps.
#include <Eigen/Core>
#include <cmath>
#include <limits>
#include <map>
#include <memory>
#include <numbers>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "data/data_set.hpp"
#include "effects/arm_state.hpp"
#include "effects/effect.hpp"
#include "effects/law_terms.hpp"
#include "effects/symbolic_state.hpp"
#include "expression/bound.hpp"
#include "kinematics/chain.hpp"
#include "kinematics/units.hpp"
#include "primitives/primitive.hpp"
#include "symbolic/algebra.hpp"

namespace demecal::inline effects {
namespace {

/// A joint's zero that is off.
class JointOffsetLaw final : public EffectLaw {
 public:
  std::string_view kind() const override { return "joint_offset"; }
  std::vector<CoefficientLabel> coefficients(const Effect& effect, const Robot& robot) const override {
    return {motion_label(robot, effect.joint, is_revolute(robot.chain, effect.joint) ? "theta" : "d")};
  }
  void unit_motions(const Effect& effect, const Robot& robot, const ArmState& /*state*/,
                    std::vector<UnitMotion>& motions) const override {
    append_joint_motion(robot, effect.joint, 0, 1.0, motions);
  }
  std::vector<Effect> proposals(const Robot& robot, const Evidence& /*evidence*/) const override {
    std::vector<Effect> effects;
    for (int joint = 0; joint < robot.chain.size(); ++joint)
      effects.push_back({.kind = "joint_offset", .joint = joint});
    return effects;
  }
  Needs needs(const Effect& /*effect*/, const Robot& /*robot*/) const override { return {}; }
  std::string formula(const Effect& effect, const Robot& robot) const override {
    return write_joint_equation(effect, robot, {{0, ""}});
  }
  std::string diagnosis(const Effect& effect, const Robot& robot) const override {
    return "The zero of joint " + std::to_string(effect.joint + 1) + " is off by " +
           motion_text(robot, effect.joint, effect.value(0)) + '.';
  }
  bool is_smooth(const Effect& /*effect*/) const override { return true; }
  void append_symbolic_motions(SymbolicWriter& writer) const override { writer.append_joint(0, writer.constant(1.0)); }
};

/// A wrong gear ratio or encoder scale.
class GainLaw final : public EffectLaw {
 public:
  std::string_view kind() const override { return "gain"; }
  std::vector<CoefficientLabel> coefficients(const Effect& /*effect*/, const Robot& /*robot*/) const override {
    return {{"share", "1"}};
  }
  void unit_motions(const Effect& effect, const Robot& robot, const ArmState& state,
                    std::vector<UnitMotion>& motions) const override {
    append_joint_motion(robot, effect.joint, 0, state.joints()[effect.joint], motions);
  }
  std::vector<Effect> proposals(const Robot& robot, const Evidence& /*evidence*/) const override {
    std::vector<Effect> effects;
    for (int joint = 0; joint < robot.chain.size(); ++joint) effects.push_back({.kind = "gain", .joint = joint});
    return effects;
  }
  Needs needs(const Effect& /*effect*/, const Robot& /*robot*/) const override { return {}; }
  std::string formula(const Effect& effect, const Robot& robot) const override {
    return write_joint_equation(effect, robot, {{0, joint_symbol(effect.joint)}});
  }
  std::string diagnosis(const Effect& effect, const Robot& /*robot*/) const override {
    return joint_name(effect.joint) + " moves " + share_text(std::abs(effect.value(0))) +
           (effect.value(0) < 0.0 ? " less" : " more") + " than it is told: its gear ratio or encoder scale is off.";
  }
  std::string_view advice(const Effect& /*effect*/) const override {
    return "Have the gear ratio and the encoder's scale in the controller checked: another gear of the same kind "
           "changes "
           "nothing. Corrected targets compensate it.";
  }
  std::vector<int> ranged_joints(const Effect& effect, const Robot& /*robot*/) const override { return {effect.joint}; }
  std::optional<HeldMotion> held_motion(const Effect& effect) const override {
    return HeldMotion{effect.joint, std::abs(effect.value(0)), std::numeric_limits<double>::infinity()};
  }
  bool is_smooth(const Effect& /*effect*/) const override { return true; }
  void append_symbolic_motions(SymbolicWriter& writer) const override { writer.append_joint(0, writer.own_joint()); }
};

/// A joint dragged along by another.
class CouplingLaw final : public EffectLaw {
 public:
  std::string_view kind() const override { return "coupling"; }
  std::vector<CoefficientLabel> coefficients(const Effect& effect, const Robot& robot) const override {
    if (harmonic(effect))
      return {motion_label(robot, effect.joint, "cosine"), motion_label(robot, effect.joint, "sine")};
    const bool revolute = is_revolute(robot.chain, effect.joint);
    if (revolute == is_revolute(robot.chain, from(effect))) return {{"share", "1"}};
    return {{"share", revolute ? "rad/m" : "m/rad"}};
  }
  void unit_motions(const Effect& effect, const Robot& robot, const ArmState& state,
                    std::vector<UnitMotion>& motions) const override {
    const double q = state.joints()[from(effect)];
    append_joint_motion(robot, effect.joint, 0, harmonic(effect) ? std::cos(q) : q, motions);
    if (harmonic(effect)) append_joint_motion(robot, effect.joint, 1, std::sin(q), motions);
  }
  std::string_view advice(const Effect& /*effect*/) const override {
    return "Another joint drags it along (a belt, a bevel wrist, a parallelogram): have the coupling in the controller "
           "checked; another gear changes nothing. Corrected targets compensate it.";
  }
  std::vector<Effect> proposals(const Robot& robot, const Evidence& /*evidence*/) const override {
    std::vector<Effect> effects;
    for (int joint = 0; joint < robot.chain.size(); ++joint) {
      for (int other = 0; other < robot.chain.size(); ++other) {
        if (other == joint) continue;
        const std::map<std::string, double> settings{{"from", other + 1.0}};
        effects.push_back({.kind = "coupling", .joint = joint, .settings = settings, .form = "linear"});
        if (!is_revolute(robot.chain, other)) continue;
        effects.push_back({.kind = "coupling", .joint = joint, .settings = settings, .form = "harmonic"});
      }
    }
    return effects;
  }
  Needs needs(const Effect& /*effect*/, const Robot& /*robot*/) const override { return {}; }
  std::string formula(const Effect& effect, const Robot& robot) const override {
    if (harmonic(effect)) return write_joint_equation(effect, robot, harmonic_terms(1.0, from(effect)));
    return write_joint_equation(effect, robot, {{0, joint_symbol(from(effect))}});
  }
  std::string diagnosis(const Effect& effect, const Robot& robot) const override {
    const std::string both =
        joint_name(effect.joint) + " is dragged along by joint " + std::to_string(from(effect) + 1);
    if (harmonic(effect)) {
      return both + ", by up to " + motion_text(robot, effect.joint, std::hypot(effect.value(0), effect.value(1))) +
             " once per turn of it.";
    }
    const std::string unit = coefficients(effect, robot)[0].unit;
    const std::string amount = unit == "1" ? share_text(effect.value(0)) : rounded_text(effect.value(0)) + ' ' + unit;
    return both + ", by " + amount + " of its motion.";
  }
  std::vector<std::string> settings() const override { return {"from"}; }
  std::vector<std::string> forms() const override { return {"linear", "harmonic"}; }
  std::vector<int> ranged_joints(const Effect& effect, const Robot& /*robot*/) const override { return {from(effect)}; }
  std::optional<HeldMotion> held_motion(const Effect& effect) const override {
    if (!harmonic(effect))
      return HeldMotion{from(effect), std::abs(effect.value(0)), std::numeric_limits<double>::infinity()};
    const double amplitude = std::hypot(effect.value(0), effect.value(1));
    return HeldMotion{from(effect), amplitude, 2.0 * amplitude};
  }
  int proportional_to(const Effect& effect) const override { return harmonic(effect) ? -1 : from(effect); }
  void append_symbolic_motions(SymbolicWriter& writer) const override {
    const Expression other = writer.joint(from(writer.effect));
    if (harmonic(writer.effect)) return writer.append_wave(other);
    writer.append_joint(0, other);
  }

 private:
  static bool harmonic(const Effect& effect) { return effect.form == "harmonic"; }
  /// The other joint, from 0; the setting counts from 1 as people do.
  static int from(const Effect& effect) { return static_cast<int>(effect.setting("from")) - 1; }
};

constexpr double kJumpTerm = 0.5;  // of its height, to either side

/// A joint that jumps at one place (step), or to and fro a few times a turn (square_wave), as an encoder or resolver
/// reads that joins its coarse to its fine track wrongly.
class JumpLaw final : public EffectLaw {
 public:
  std::string_view kind() const override { return "jump"; }
  std::vector<CoefficientLabel> coefficients(const Effect& effect, const Robot& robot) const override {
    return {motion_label(robot, effect.joint, "height")};
  }
  void unit_motions(const Effect& effect, const Robot& robot, const ArmState& state,
                    std::vector<UnitMotion>& motions) const override {
    const double beyond = state.joints()[effect.joint] - effect.setting(kAt);
    const double side = is_square(effect) ? std::sin(effect.setting(kPerTurn) * beyond) : beyond;
    append_joint_motion(robot, effect.joint, 0, kJumpTerm * sign_of(side), motions);
  }
  /// Places over the joints' ranges, which finer_proposals() lie between.
  std::vector<Effect> proposals(const Robot& robot, const Evidence& evidence) const override {
    std::vector<Effect> effects;
    for (int joint = 0; joint < robot.chain.size(); ++joint) {
      if (!is_revolute(robot.chain, joint)) continue;
      const Interval range = range_of(joint, evidence);
      for (int place = 1; place < kPlaces; ++place)
        effects.push_back(step(joint, std::lerp(range.lower, range.upper, place / static_cast<double>(kPlaces))));
      for (int per_turn = 2; per_turn <= kMostPerTurn; ++per_turn) {
        if (per_turn * (range.upper - range.lower) < kTurn_rad) continue;  // one jump among the poses is a step
        for (int phase = 0; phase < kPhases; ++phase)
          effects.push_back(square(joint, per_turn, phase * kTurn_rad / (2.0 * per_turn * kPhases)));
      }
    }
    return effects;
  }
  std::vector<Effect> finer_proposals(const Effect& effect, const Evidence& evidence) const override {
    const Interval range = range_of(effect.joint, evidence);
    const double apart = is_square(effect) ? kTurn_rad / (2.0 * effect.setting(kPerTurn) * kPhases)
                                           : (range.upper - range.lower) / kPlaces;
    std::vector<Effect> finer;
    for (int part = -kFiner; part <= kFiner; ++part) {
      finer.push_back(effect);
      finer.back().settings[kAt] += part * apart / kFiner;
    }
    return finer;
  }
  bool is_last_resort() const override { return true; }
  Needs needs(const Effect& /*effect*/, const Robot& /*robot*/) const override { return {}; }
  std::string formula(const Effect& effect, const Robot& robot) const override {
    const std::string beyond = joint_symbol(effect.joint) + (effect.setting(kAt) < 0.0 ? " + " : " - ") +
                               significant_text(std::abs(effect.setting(kAt)), 5) + " rad";
    const std::string side =
        is_square(effect) ? "sin(" + rounded_text(effect.setting(kPerTurn)) + " (" + beyond + "))" : beyond;
    return write_joint_equation(effect, robot, {{0, "sign(" + side + ")", kJumpTerm}});
  }
  std::string diagnosis(const Effect& effect, const Robot& robot) const override {
    const std::string height = motion_text(robot, effect.joint, std::abs(effect.value(0)));
    const std::string at = significant_text(degrees(effect.setting(kAt)), 5) + " deg";
    const std::string what = is_square(effect) ? " jumps to and fro by " + height + ", " +
                                                     times_per_turn(effect.setting(kPerTurn)) + ", one of them at " + at
                                               : " jumps at " + at + ": beyond it, it stands " + height +
                                                     (effect.value(0) < 0.0 ? " less far" : " further");
    return joint_name(effect.joint) + what +
           (is_square(effect) ? ": an encoder or resolver that joins its coarse to its fine track wrongly."
                              : ": an encoder that loses counts there, or something that slips or is broken.");
  }
  std::string_view advice(const Effect& /*effect*/) const override {
    return "Have the joint's encoder or resolver, and how it is mounted, checked. Corrected targets compensate it, but "
           "not those close to a jump: which side of it a joint stops at is not known.";
  }
  std::vector<std::string> settings() const override { return {kAt, kPerTurn}; }
  bool requires_setting(const Effect& effect, const std::string& name) const override {
    return name == kAt || is_square(effect);
  }
  std::vector<std::string> forms() const override { return {"step", kSquare}; }
  std::vector<int> ranged_joints(const Effect& effect, const Robot& /*robot*/) const override { return {effect.joint}; }
  /// Right beyond the measured range it may jump again.
  std::optional<HeldMotion> held_motion(const Effect& effect) const override {
    return HeldMotion{effect.joint, std::abs(effect.value(0)) / kTooClose_rad, std::abs(effect.value(0))};
  }
  void append_symbolic_motions(SymbolicWriter& writer) const override {
    const Expression beyond = writer.own_joint() - writer.effect.setting(kAt);
    const Expression side = is_square(writer.effect) ? sine(writer.effect.setting(kPerTurn) * beyond) : beyond;
    writer.append_joint(0, kJumpTerm * side.algebra().function(Function::sign, {side}));
  }

 private:
  static constexpr const char *kAt = "at_rad", *kPerTurn = "per_turn", *kSquare = "square_wave";
  static constexpr int kPlaces = 25, kPhases = 6, kMostPerTurn = 12, kFiner = 32;
  static constexpr double kTurn_rad = 2.0 * std::numbers::pi, kTooClose_rad = 1e-3;

  static bool is_square(const Effect& effect) { return effect.form == kSquare; }
  static Effect step(int joint, double at_rad) {
    return {.kind = "jump", .joint = joint, .settings = {{kAt, at_rad}}, .form = "step"};
  }
  static Effect square(int joint, int per_turn, double at_rad) {
    return {.kind = "jump", .joint = joint, .settings = {{kAt, at_rad}, {kPerTurn, per_turn}}, .form = kSquare};
  }
  /// Of a joint of which nothing is known, a whole turn.
  static Interval range_of(int joint, const Evidence& evidence) {
    const auto place = static_cast<std::size_t>(joint);
    return place < evidence.joint_ranges.size() ? evidence.joint_ranges[place]
                                                : Interval{-std::numbers::pi, std::numbers::pi};
  }
};

}  // namespace

const EffectLaw& joint_offset_law() {
  static const JointOffsetLaw law;
  return law;
}

const EffectLaw& gain_law() {
  static const GainLaw law;
  return law;
}

const EffectLaw& jump_law() {
  static const JumpLaw law;
  return law;
}

const EffectLaw& coupling_law() {
  static const CouplingLaw law;
  return law;
}

}  // namespace demecal::inline effects
