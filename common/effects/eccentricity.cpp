#include <cmath>

#include "effects/joint_words.hpp"
#include "effects/laws.hpp"

namespace demecal {
namespace {

/// A gear or encoder disc off its centre: one or two periods a turn.
class Eccentricity final : public EffectLaw {
 public:
  std::string_view kind() const override { return "eccentricity"; }
  std::vector<CoefficientLabel> coefficients(const Effect& effect, const Robot& robot) const override {
    return {motion_label(robot, effect.joint, "cosine"), motion_label(robot, effect.joint, "sine")};
  }
  void unit_motions(const Effect& effect, const Robot& robot, const ArmState& state,
                    std::vector<UnitMotion>& motions) const override {
    const double angle = effect.setting("order") * state.joints()[effect.joint];
    append_joint_motion(robot, effect.joint, 0, std::cos(angle), motions);
    append_joint_motion(robot, effect.joint, 1, std::sin(angle), motions);
  }
  std::vector<Effect> proposals(const Robot& robot, const Evidence& /*evidence*/) const override {
    std::vector<Effect> effects;
    for (int joint = 0; joint < robot.chain.size(); ++joint) {
      if (!is_revolute(robot, joint)) continue;
      for (const double order : {1.0, 2.0}) {
        effects.push_back({.kind = "eccentricity", .joint = joint, .settings = {{"order", order}}});
      }
    }
    return effects;
  }
  Needs needs(const Effect& /*effect*/, const Robot& /*robot*/) const override { return {}; }
  std::string formula(const Effect& effect, const Robot& robot) const override {
    return write_joint_equation(effect, robot, harmonic_terms(effect.setting("order"), effect.joint));
  }
  std::string diagnosis(const Effect& effect, const Robot& robot) const override {
    return joint_name(effect.joint) + " swings by " +
           motion_words(robot, effect.joint, std::hypot(effect.value(0), effect.value(1))) + " to either side, " +
           times_per_turn(effect.setting("order")) + ": a gear or encoder disc runs off its centre.";
  }
  std::vector<std::string> settings() const override { return {"order"}; }
  std::vector<int> ranged_joints(const Effect& effect, const Robot& /*robot*/) const override { return {effect.joint}; }
};

}  // namespace

const EffectLaw& eccentricity_law() {
  static const Eccentricity law;
  return law;
}

}  // namespace demecal
