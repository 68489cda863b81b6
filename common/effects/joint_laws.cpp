// What is wrong with a joint by its own drive or by another's: its zero, its gain, and coupling.
#include <Eigen/Core>
#include <cmath>
#include <limits>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "data/data_set.hpp"
#include "effects/arm_state.hpp"
#include "effects/effect.hpp"
#include "effects/law_terms.hpp"
#include "effects/symbolic_state.hpp"
#include "kinematics/chain.hpp"
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

}  // namespace

const EffectLaw& joint_offset_law() {
  static const JointOffsetLaw law;
  return law;
}

const EffectLaw& gain_law() {
  static const GainLaw law;
  return law;
}

const EffectLaw& coupling_law() {
  static const CouplingLaw law;
  return law;
}

}  // namespace demecal::inline effects
