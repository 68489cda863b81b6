// What grows and shifts as the arm warms up: links and joints' zeros.
#include <Eigen/Core>
#include <cmath>
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "data/data_set.hpp"
#include "effects/arm_state.hpp"
#include "effects/effect.hpp"
#include "effects/law_terms.hpp"
#include "effects/symbolic_state.hpp"
#include "kinematics/chain.hpp"

namespace demecal::inline effects {
namespace {

const Joint& link_of(const Robot& robot, const Effect& effect) {
  return robot.chain.joints[static_cast<std::size_t>(effect.joint)];
}

/// A link that grows as the arm warms up: its d and a by the same share.
class ThermalLengthLaw final : public EffectLaw {
 public:
  std::string_view kind() const override { return "thermal_length"; }
  std::vector<CoefficientLabel> coefficients(const Effect& /*effect*/, const Robot& /*robot*/) const override {
    return {{"share_per_kelvin", "1/K"}};
  }
  void unit_motions(const Effect& effect, const Robot& robot, const ArmState& state,
                    std::vector<UnitMotion>& motions) const override {
    const double warming = warming_kelvin(effect, state.stop);
    const Joint& link = link_of(robot, effect);
    const double q = state.driven[effect.joint];
    append_link_motion(robot.chain, effect.joint, q, LinkParameter::d, 0, warming * link.d_m, motions);
    append_link_motion(robot.chain, effect.joint, q, LinkParameter::a, 0, warming * link.a_m, motions);
  }
  std::vector<Effect> proposals(const Robot& robot, const Evidence& evidence) const override {
    std::vector<Effect> effects;
    for (int joint = 0; evidence.temperature && joint < robot.chain.size(); ++joint) {
      Effect effect{.kind = "thermal_length",
                    .joint = joint,
                    .settings = {{"reference_celsius", evidence.mean_temperature_celsius}}};
      const Joint& link = link_of(robot, effect);
      if (link.d_m != 0.0 || link.a_m != 0.0) effects.push_back(std::move(effect));
    }
    return effects;
  }
  Needs needs(const Effect& /*effect*/, const Robot& /*robot*/) const override { return {.temperature = true}; }
  std::string formula(const Effect& effect, const Robot& robot) const override {
    const std::string joint = std::to_string(effect.joint + 1);
    const std::string warming = ' ' + warming_symbol(effect);
    return write_equations(
        effect, robot, {{"da" + joint, {{0, 'a' + joint + warming}}}, {"dd" + joint, {{0, 'd' + joint + warming}}}});
  }
  std::string diagnosis(const Effect& effect, const Robot& robot) const override {
    const Joint& link = link_of(robot, effect);
    return "Link " + std::to_string(effect.joint + 1) + " grows by " + share_text(effect.value(0)) +
           " per kelvin as the arm warms up: " + length_text(effect.value(0) * std::hypot(link.a_m, link.d_m)) +
           " per kelvin over its length.";
  }
  std::string implausibility(const Effect& effect) const override {
    constexpr double kMost_per_kelvin = 150e-6;  // aluminium grows by 23e-6; parts may warm more than the thermometer
    return std::abs(effect.value(0)) > kMost_per_kelvin ? "no link grows so much with temperature (> 150 ppm/K; "
                                                          "aluminium: 23): what it follows is something else"
                                                        : "";
  }
  std::vector<std::string> settings() const override { return {"reference_celsius"}; }
  Circumstance prerequisite() const override { return Circumstance::temperature; }
  void append_symbolic_motions(SymbolicWriter& writer) const override {
    const Joint& link = link_of(writer.robot(), writer.effect);
    writer.append_link(0, LinkParameter::d, link.d_m * writer.warming());
    writer.append_link(0, LinkParameter::a, link.a_m * writer.warming());
  }
};

/// A joint's zero that moves as the arm warms up.
class ThermalOffsetLaw final : public EffectLaw {
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
           motion_text(robot, effect.joint, effect.value(0)) + " per kelvin as the arm warms up.";
  }
  std::vector<std::string> settings() const override { return {"reference_celsius"}; }
  Circumstance prerequisite() const override { return Circumstance::temperature; }
  std::optional<DecoyEffect> decoy(const Effect& effect, const Evidence& /*evidence*/) const override {
    return DecoyEffect{effect, DecoyKind::shuffled_temperature};
  }
  void append_symbolic_motions(SymbolicWriter& writer) const override { writer.append_joint(0, writer.warming()); }
};

}  // namespace

const EffectLaw& thermal_length_law() {
  static const ThermalLengthLaw law;
  return law;
}

const EffectLaw& thermal_offset_law() {
  static const ThermalOffsetLaw law;
  return law;
}

}  // namespace demecal::inline effects
