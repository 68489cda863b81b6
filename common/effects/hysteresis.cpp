#include <cmath>

#include "effects/joint_words.hpp"
#include "effects/laws.hpp"
#include "effects/sampled_states.hpp"

namespace demecal {
namespace {

/// Friction against the gear's spring: the joint stops short by friction_rad + friction_rad_per_nm |tau|. Linear in
/// both; a scenario's per_nm is the ratio of the two.
class Hysteresis final : public EffectLaw {
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
    return joint_name(effect.joint) + " stops " + motion_words(robot, effect.joint, std::abs(friction)) +
           (friction < 0.0 ? " beyond" : " short") + " on either side of where it is sent, and " +
           motion_words(robot, effect.joint, std::abs(by_load)) + (by_load * friction < 0.0 ? " less" : " more") +
           " per " + load_unit(robot, effect.joint) +
           " of gravity's pull on it: friction held by the spring of its gear.";
  }
};

}  // namespace

const EffectLaw& hysteresis_law() {
  static const Hysteresis law;
  return law;
}

}  // namespace demecal
