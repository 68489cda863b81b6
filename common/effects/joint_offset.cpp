#include "effects/joint_words.hpp"
#include "effects/laws.hpp"

namespace demecal {
namespace {

/// A joint's zero that is off.
class JointOffset final : public EffectLaw {
 public:
  std::string_view kind() const override { return "joint_offset"; }
  std::vector<CoefficientLabel> coefficients(const Effect& effect, const Robot& robot) const override {
    return {motion_label(robot, effect.joint, is_revolute(robot, effect.joint) ? "theta" : "d")};
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
           motion_words(robot, effect.joint, effect.value(0)) + '.';
  }
};

}  // namespace

const EffectLaw& joint_offset_law() {
  static const JointOffset law;
  return law;
}

}  // namespace demecal
