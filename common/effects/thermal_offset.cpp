#include "effects/joint_words.hpp"
#include "effects/laws.hpp"
#include "effects/warming.hpp"

namespace demecal {
namespace {

/// A joint's zero that moves as the arm warms up.
class ThermalOffset final : public EffectLaw {
 public:
  std::string_view kind() const override { return "thermal_offset"; }
  std::vector<CoefficientLabel> coefficients(const Effect& effect, const Robot& robot) const override {
    const CoefficientLabel motion = motion_label(robot, effect.joint, "");
    return {{motion.unit + "_per_kelvin", motion.unit + "/K"}};
  }
  void unit_motions(const Effect& effect, const Robot& robot, const ArmState& state,
                    std::vector<UnitMotion>& motions) const override {
    append_joint_motion(robot, effect.joint, 0, warming_kelvin(effect, state.stop), motions);
  }
  std::vector<Effect> proposals(const Robot& robot, const Evidence& evidence) const override {
    std::vector<Effect> effects;
    for (int joint = 0; evidence.temperature && joint < robot.chain.size(); ++joint) {
      effects.push_back({.kind = "thermal_offset",
                         .joint = joint,
                         .settings = {{"reference_celsius", evidence.mean_temperature_celsius}}});
    }
    return effects;
  }
  Needs needs(const Effect& /*effect*/, const Robot& /*robot*/) const override { return {.temperature = true}; }
  std::string formula(const Effect& effect, const Robot& robot) const override {
    return write_joint_equation(effect, robot, {{0, warming_symbol(effect)}});
  }
  std::string diagnosis(const Effect& effect, const Robot& robot) const override {
    return "The zero of joint " + std::to_string(effect.joint + 1) + " moves by " +
           motion_words(robot, effect.joint, effect.value(0)) + " per kelvin as the arm warms up.";
  }
  std::vector<std::string> settings() const override { return {"reference_celsius"}; }
};

}  // namespace

const EffectLaw& thermal_offset_law() {
  static const ThermalOffset law;
  return law;
}

}  // namespace demecal
