// A law that no catalogue has: hoses along the arm pull a joint by the square of how far the joint before it has
// turned.
#include <string>
#include <string_view>
#include <vector>

#include "data/data_set.hpp"
#include "effects/arm_state.hpp"
#include "effects/effect.hpp"
#include "effects/law_terms.hpp"

namespace demecal::inline effects {
namespace {

class HosePullLaw final : public EffectLaw {
 public:
  std::string_view kind() const override { return "hose_pull"; }
  std::vector<CoefficientLabel> coefficients(const Effect& /*effect*/, const Robot& /*robot*/) const override {
    return {{"per_rad", "1/rad"}};
  }
  void unit_motions(const Effect& effect, const Robot& robot, const ArmState& state,
                    std::vector<UnitMotion>& motions) const override {
    const double turned = state.driven[effect.joint - 1];
    append_joint_motion(robot, effect.joint, 0, turned * turned, motions);
  }
  std::vector<Effect> proposals(const Robot& robot, const Evidence& /*evidence*/) const override {
    std::vector<Effect> effects;
    for (int joint = 1; joint < robot.chain.size(); ++joint) effects.push_back({.kind = "hose_pull", .joint = joint});
    return effects;
  }
  Needs needs(const Effect& /*effect*/, const Robot& /*robot*/) const override { return {}; }
  std::string formula(const Effect& effect, const Robot& robot) const override {
    return write_joint_equation(effect, robot, {{0, joint_symbol(effect.joint - 1) + "^2"}});
  }
  std::string diagnosis(const Effect& effect, const Robot& robot) const override {
    return "Hoses pull " + joint_name(effect.joint) + " by up to " + motion_text(robot, effect.joint, effect.value(0)) +
           " per squared radian.";
  }
};

}  // namespace

const EffectLaw& hose_pull_law() {
  static const HosePullLaw law;
  return law;
}

}  // namespace demecal::inline effects
