#include <cmath>

#include "effects/joint_words.hpp"
#include "effects/laws.hpp"

namespace demecal {
namespace {

/// A wrong gear ratio or encoder scale.
class Gain final : public EffectLaw {
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
    return joint_name(effect.joint) + " moves " + share_words(std::abs(effect.value(0))) +
           (effect.value(0) < 0.0 ? " less" : " more") + " than it is told: its gear ratio or encoder scale is off.";
  }
  std::vector<int> ranged_joints(const Effect& effect, const Robot& /*robot*/) const override { return {effect.joint}; }
};

}  // namespace

const EffectLaw& gain_law() {
  static const Gain law;
  return law;
}

}  // namespace demecal
