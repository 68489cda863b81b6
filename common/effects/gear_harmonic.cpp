#include <cmath>

#include "effects/joint_words.hpp"
#include "effects/laws.hpp"

namespace demecal {
namespace {

constexpr double kRipple = 6.0;  // so many periods a turn and more average out where nothing is known of them
constexpr int kLowestRatio = 3;  // one and two periods a turn are eccentricity

/// The transmission error of a gear stage: N periods a turn of the joint.
class GearHarmonic final : public EffectLaw {
 public:
  std::string_view kind() const override { return "gear_harmonic"; }
  std::vector<CoefficientLabel> coefficients(const Effect& effect, const Robot& robot) const override {
    return {motion_label(robot, effect.joint, "cosine"), motion_label(robot, effect.joint, "sine")};
  }
  void unit_motions(const Effect& effect, const Robot& robot, const ArmState& state,
                    std::vector<UnitMotion>& motions) const override {
    const double angle = effect.setting("ratio") * state.joints()[effect.joint];
    append_joint_motion(robot, effect.joint, 0, std::cos(angle), motions);
    append_joint_motion(robot, effect.joint, 1, std::sin(angle), motions);
  }
  std::vector<Effect> proposals(const Robot& robot, const Evidence& evidence) const override {
    const std::vector<double> ratios = ratios_to_try(evidence);
    std::vector<Effect> effects;
    for (int joint = 0; joint < robot.chain.size(); ++joint) {
      if (!is_revolute(robot, joint)) continue;
      for (const double ratio : ratios) {
        effects.push_back({.kind = "gear_harmonic", .joint = joint, .settings = {{"ratio", ratio}}});
      }
    }
    return effects;
  }
  bool fades(const Effect& effect) const override { return effect.setting("ratio") >= kRipple; }
  Needs needs(const Effect& /*effect*/, const Robot& /*robot*/) const override { return {}; }
  std::string formula(const Effect& effect, const Robot& robot) const override {
    return write_joint_equation(effect, robot, harmonic_terms(effect.setting("ratio"), effect.joint));
  }
  std::string diagnosis(const Effect& effect, const Robot& robot) const override {
    return joint_name(effect.joint) + " swings by " +
           motion_words(robot, effect.joint, std::hypot(effect.value(0), effect.value(1))) + " to either side, " +
           times_per_turn(effect.setting("ratio")) + ": the transmission error of a gear stage.";
  }
  std::vector<std::string> settings() const override { return {"ratio"}; }
  std::vector<int> ranged_joints(const Effect& effect, const Robot& /*robot*/) const override { return {effect.joint}; }

 private:
  static std::vector<double> ratios_to_try(const Evidence& evidence) {
    std::vector<double> ratios;
    for (int ratio = kLowestRatio; ratio <= evidence.highest_ratio; ++ratio) ratios.push_back(ratio);
    for (const double stated : evidence.stated_ratios) {
      const bool scanned = stated == std::round(stated) && stated <= evidence.highest_ratio;
      if (!scanned && stated > 0.0) ratios.push_back(stated);
    }
    return ratios;
  }
};

}  // namespace

const EffectLaw& gear_harmonic_law() {
  static const GearHarmonic law;
  return law;
}

}  // namespace demecal
