// What follows from the side that a joint came from: backlash and hysteresis.
#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "data/data_set.hpp"
#include "effects/arm_state.hpp"
#include "effects/effect.hpp"
#include "effects/law_terms.hpp"
#include "effects/symbolic_state.hpp"
#include "effects/weight_parts.hpp"
#include "kinematics/chain.hpp"
#include "symbolic/algebra.hpp"

namespace demecal::inline effects {
namespace {

/// The load that seats a gear, of the joint's median load.
constexpr double kSeatingShare = 0.2;

/// Of a joint that stops beyond where it is sent: it has no lost motion, whatever its effects are called.
constexpr std::string_view kStopsBeyond =
    "The joint stops beyond where it is sent: see whether the signs of approach in the data are the right way round, "
    "and "
    "whether the controller makes up for too much lost motion. Do not correct programs before that is known.";

/// Lost motion: the joint stops half of it short on either side, or rests on the side its load pushes it to; or another
/// joint's lost motion drags it along, as in differentials and wrists whose drives run through one another.
class BacklashLaw final : public EffectLaw {
 public:
  std::string_view kind() const override { return "backlash"; }
  std::vector<CoefficientLabel> coefficients(const Effect& effect, const Robot& robot) const override {
    return {motion_label(robot, effect.joint, "width")};
  }
  void unit_motions(const Effect& effect, const Robot& robot, const ArmState& state,
                    std::vector<UnitMotion>& motions) const override {
    append_joint_motion(robot, effect.joint, 0, 0.5 * side(effect, robot, state), motions);
  }
  std::vector<Effect> proposals(const Robot& robot, const Evidence& evidence) const override;
  Needs needs(const Effect& effect, const Robot& /*robot*/) const override {
    return {.approach = !seated(effect), .masses = seated(effect)};
  }
  std::string formula(const Effect& effect, const Robot& robot) const override;
  std::string diagnosis(const Effect& effect, const Robot& robot) const override;
  std::vector<std::string> settings() const override { return {"from", "torque0_nm"}; }
  bool requires_setting(const Effect& effect, const std::string& name) const override {
    return name == "from" ? coupled(effect) : seated(effect);
  }
  std::vector<std::string> forms() const override { return {"approach", "seated", "coupled"}; }
  Circumstance prerequisite() const override { return Circumstance::approach; }
  std::string_view reversal(const Effect& effect) const override {
    return !seated(effect) && !coupled(effect) && effect.value(0) < 0.0 ? kStopsBeyond : std::string_view();
  }
  std::optional<DecoyEffect> decoy(const Effect& effect, const Evidence& /*evidence*/) const override {
    if (seated(effect) || coupled(effect)) return std::nullopt;
    return DecoyEffect{effect, DecoyKind::shuffled_approach};
  }
  void append_symbolic_motions(SymbolicWriter& writer) const override {
    const Effect& effect = writer.effect;
    if (!seated(effect)) return writer.append_joint(0, -0.5 * writer.state.approach(approaching(effect)));
    const Expression share = writer.torque(effect.joint) / writer.constant(effect.setting("torque0_nm"));
    writer.append_joint(0, 0.5 * writer.state.algebra().function(Function::hyperbolic_tangent, {share}));
  }

 private:
  static bool seated(const Effect& effect) { return effect.form == "seated"; }
  static bool coupled(const Effect& effect) { return effect.form == "coupled"; }
  /// The joint whose approach counts, from 0.
  static int approaching(const Effect& effect) {
    return coupled(effect) ? static_cast<int>(effect.setting("from")) - 1 : effect.joint;
  }
  /// To which side of the play the joint stands: from -1 to 1.
  static double side(const Effect& effect, const Robot& robot, const ArmState& state) {
    if (!seated(effect)) return -state.approach(approaching(effect));
    return std::tanh(state.torque(robot.chain, effect.joint) / effect.setting("torque0_nm"));
  }
};

std::vector<Effect> BacklashLaw::proposals(const Robot& robot, const Evidence& evidence) const {
  std::vector<Effect> effects;
  const std::vector<ArmState> states = sampled_states(robot, evidence, 0.0);
  for (int joint = 0; joint < robot.chain.size(); ++joint) {
    if (evidence.approach) effects.push_back({.kind = "backlash", .joint = joint, .settings = {}, .form = "approach"});
    for (int from = 0; from < robot.chain.size() && evidence.approach; ++from) {
      if (from == joint) continue;
      effects.push_back({.kind = "backlash", .joint = joint, .settings = {{"from", from + 1.0}}, .form = "coupled"});
    }
    if (!evidence.masses) continue;
    const double torque0 = kSeatingShare * torques_by_size(robot, states, joint)[states.size() / 2];
    if (torque0 < kNoLoad) continue;
    effects.push_back({.kind = "backlash", .joint = joint, .settings = {{"torque0_nm", torque0}}, .form = "seated"});
  }
  return effects;
}

std::string BacklashLaw::formula(const Effect& effect, const Robot& robot) const {
  const std::string joint = std::to_string(approaching(effect) + 1);
  if (!seated(effect)) return write_joint_equation(effect, robot, {{0, 's' + joint, -0.5}});
  const std::string load = "tau" + joint + " / " + rounded_text(effect.setting("torque0_nm"));
  return write_joint_equation(effect, robot, {{0, "tanh(" + load + ' ' + load_unit(robot, effect.joint) + ')', 0.5}});
}

std::string BacklashLaw::diagnosis(const Effect& effect, const Robot& robot) const {
  const double width = effect.value(0);
  const std::string half = motion_text(robot, effect.joint, 0.5 * std::abs(width));
  if (seated(effect)) {
    return joint_name(effect.joint) + " stands " + half + " off on the side its load pushes it " +
           (width < 0.0 ? "away from" : "to") +
           (width < 0.0 ? ", which lost motion does not explain." : ": lost motion in its gear.");
  }
  if (coupled(effect)) {
    return joint_name(effect.joint) + " is carried " + half + " along to either side by the lost motion of joint " +
           std::to_string(approaching(effect) + 1) + ", whose drive it shares.";
  }
  if (width < 0.0) {
    return joint_name(effect.joint) + " stops " + half +
           " beyond where it is sent, on either side: too much for its lost motion is made up for, or the signs of "
           "approach are stated the wrong way round.";
  }
  return joint_name(effect.joint) + " stops " + half +
         " short on either side of where it is sent: lost motion in its gear.";
}

/// Friction against the gear's spring: the joint stops short by friction_rad + friction_rad_per_nm |tau|. Linear in
/// both; a scenario's per_nm is the ratio of the two.
class HysteresisLaw final : public EffectLaw {
 public:
  std::string_view kind() const override { return "hysteresis"; }
  std::vector<CoefficientLabel> coefficients(const Effect& effect, const Robot& robot) const override {
    return {motion_label(robot, effect.joint, "friction"), compliance_label(robot, effect.joint, "friction")};
  }
  void unit_motions(const Effect& effect, const Robot& robot, const ArmState& state,
                    std::vector<UnitMotion>& motions) const override {
    const double side = state.approach(effect.joint);
    append_joint_motion(robot, effect.joint, 0, -side, motions);
    append_joint_motion(robot, effect.joint, 1, -side * std::abs(state.torque(robot.chain, effect.joint)), motions);
  }
  std::string_view reversal(const Effect& effect) const override {
    const auto [least, most] = std::minmax({effect.value(0), effect.value(1)});
    return least < 0.0 && most <= 0.0 ? kStopsBeyond : std::string_view();
  }
  std::vector<Effect> proposals(const Robot& robot, const Evidence& evidence) const override {
    std::vector<Effect> effects;
    if (!evidence.approach || !evidence.masses) return effects;
    const std::vector<ArmState> states = sampled_states(robot, evidence, 0.0);
    for (int joint = 0; joint < robot.chain.size(); ++joint) {
      // Under a load that never changes it is backlash.
      const std::vector<double> torques = torques_by_size(robot, states, joint);
      if (torques.back() - torques.front() > kNoLoad) effects.push_back({.kind = "hysteresis", .joint = joint});
    }
    return effects;
  }
  Needs needs(const Effect& /*effect*/, const Robot& /*robot*/) const override {
    return {.approach = true, .masses = true};
  }
  std::string formula(const Effect& effect, const Robot& robot) const override {
    const std::string joint = std::to_string(effect.joint + 1);
    return write_joint_equation(effect, robot,
                                {{0, 's' + joint, -1.0}, {1, 's' + joint + " |tau" + joint + '|', -1.0}});
  }
  std::string diagnosis(const Effect& effect, const Robot& robot) const override {
    const double friction = effect.value(0), by_load = effect.value(1);
    return joint_name(effect.joint) + " stops " + motion_text(robot, effect.joint, std::abs(friction)) +
           (friction < 0.0 ? " beyond" : " short") + " on either side of where it is sent, and " +
           motion_text(robot, effect.joint, std::abs(by_load)) + (by_load * friction < 0.0 ? " less" : " more") +
           " per " + load_unit(robot, effect.joint) +
           " of gravity's pull on it: friction held by the spring of its gear.";
  }
  Circumstance prerequisite() const override { return Circumstance::approach; }
  void append_symbolic_motions(SymbolicWriter& writer) const override {
    const int joint = writer.effect.joint;
    const Expression side = -writer.state.approach(joint);
    writer.append_joint(0, side);
    writer.append_joint(1, side * writer.state.algebra().function(Function::absolute, {writer.torque(joint)}));
  }
};

}  // namespace

const EffectLaw& backlash_law() {
  static const BacklashLaw law;
  return law;
}

const EffectLaw& hysteresis_law() {
  static const HysteresisLaw law;
  return law;
}

}  // namespace demecal::inline effects
