// What jumps in a joint: a step at one place, or a square wave of a few periods a turn.
#include <cmath>
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

constexpr double kToEitherSide = 0.5;  // of its height

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
    append_joint_motion(robot, effect.joint, 0, kToEitherSide * sign_of(side), motions);
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
      finer.back().settings[kWithin] = apart / kFiner;
    }
    return finer;
  }
  Effect between(const Effect& first, const Effect& last) const override {
    Effect effect = first;
    effect.settings[kAt] = 0.5 * (first.setting(kAt) + last.setting(kAt));
    effect.settings[kWithin] += 0.5 * (last.setting(kAt) - first.setting(kAt));
    return effect;
  }
  bool is_last_resort() const override { return true; }
  Needs needs(const Effect& /*effect*/, const Robot& /*robot*/) const override { return {}; }
  std::string formula(const Effect& effect, const Robot& robot) const override {
    const std::string beyond = joint_symbol(effect.joint) + (effect.setting(kAt) < 0.0 ? " + " : " - ") +
                               significant_text(std::abs(effect.setting(kAt)), 5) + " rad";
    const std::string side =
        is_square(effect) ? "sin(" + rounded_text(effect.setting(kPerTurn)) + " (" + beyond + "))" : beyond;
    return write_joint_equation(effect, robot, {{0, "sign(" + side + ")", kToEitherSide}});
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
  double unsure_motion(const Effect& effect, double joint) const override {
    const auto within = effect.settings.find(kWithin);
    const double beyond = joint - effect.setting(kAt);
    const double off =
        std::remainder(beyond, is_square(effect) ? 0.5 * kTurn_rad / effect.setting(kPerTurn) : kTurn_rad);
    return within != effect.settings.end() && std::abs(off) <= within->second ? std::abs(effect.value(0)) : 0.0;
  }
  std::vector<std::string> settings() const override { return {kAt, kPerTurn, kWithin}; }
  bool requires_setting(const Effect& effect, const std::string& name) const override {
    return name == kAt || (name == kPerTurn && is_square(effect));
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
    writer.append_joint(0, kToEitherSide * side.algebra().function(Function::sign, {side}));
  }

 private:
  static constexpr const char *kAt = "at_rad", *kPerTurn = "per_turn", *kWithin = "within_rad",
                              *kSquare = "square_wave";
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

const EffectLaw& jump_law() {
  static const JumpLaw law;
  return law;
}

}  // namespace demecal::inline effects
