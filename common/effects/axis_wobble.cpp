#include <cmath>

#include "effects/joint_words.hpp"
#include "effects/laws.hpp"

namespace demecal {
namespace {

/// A turning axis that tilts about x and y of its own place, once or twice a turn.
class AxisWobble final : public EffectLaw {
 public:
  std::string_view kind() const override { return "axis_wobble"; }
  std::vector<CoefficientLabel> coefficients(const Effect& /*effect*/, const Robot& /*robot*/) const override {
    return {{"cosine_x_rad", "rad"}, {"cosine_y_rad", "rad"}, {"sine_x_rad", "rad"}, {"sine_y_rad", "rad"}};
  }
  void unit_motions(const Effect& effect, const Robot& /*robot*/, const ArmState& state,
                    std::vector<UnitMotion>& motions) const override {
    const double angle = effect.setting("order") * state.joints()[effect.joint];
    for (int axis = 0; axis < 2; ++axis) {
      motions.push_back({axis, effect.joint, 3 + axis, std::cos(angle)});
      motions.push_back({2 + axis, effect.joint, 3 + axis, std::sin(angle)});
    }
  }
  std::vector<Effect> proposals(const Robot& robot, const Evidence& /*evidence*/) const override {
    std::vector<Effect> effects;
    for (int joint = 0; joint < robot.chain.size(); ++joint) {
      if (!is_revolute(robot, joint)) continue;
      for (const double order : {1.0, 2.0}) {
        effects.push_back({.kind = "axis_wobble", .joint = joint, .settings = {{"order", order}}});
      }
    }
    return effects;
  }
  Needs needs(const Effect& /*effect*/, const Robot& /*robot*/) const override { return {}; }
  std::string formula(const Effect& effect, const Robot& robot) const override {
    const std::vector<Term> harmonic = harmonic_terms(effect.setting("order"), effect.joint);
    const std::string joint = std::to_string(effect.joint + 1);
    return write_equations(effect, robot,
                           {{"tilt_x" + joint, {{0, harmonic[0].factor}, {2, harmonic[1].factor}}},
                            {"tilt_y" + joint, {{1, harmonic[0].factor}, {3, harmonic[1].factor}}}});
  }
  std::string diagnosis(const Effect& effect, const Robot& /*robot*/) const override {
    return "The axis of joint " + std::to_string(effect.joint + 1) + " wobbles as it turns, " +
           times_per_turn(effect.setting("order")) + ": by up to " +
           angle_words(std::hypot(effect.value(0), effect.value(2))) + " about its x and " +
           angle_words(std::hypot(effect.value(1), effect.value(3))) + " about its y, as a bearing off its seat does.";
  }
  std::vector<std::string> settings() const override { return {"order"}; }
  std::vector<int> ranged_joints(const Effect& effect, const Robot& /*robot*/) const override { return {effect.joint}; }
};

}  // namespace

const EffectLaw& axis_wobble_law() {
  static const AxisWobble law;
  return law;
}

}  // namespace demecal
