#include <algorithm>
#include <cmath>

#include "effects/joint_words.hpp"
#include "effects/laws.hpp"
#include "effects/sampled_states.hpp"

namespace demecal {
namespace {

const Eigen::Vector3d& moment_nm(const ArmState& state, int joint) {
  return state.loads[static_cast<std::size_t>(joint)].moment_nm;
}

/// A bearing, and the link before it, that give way across the axis under the moment of gravity there.
class LinkBending final : public EffectLaw {
 public:
  std::string_view kind() const override { return "link_bending"; }
  std::vector<CoefficientLabel> coefficients(const Effect& /*effect*/, const Robot& /*robot*/) const override {
    return {{"x_rad_per_nm", "rad/Nm"}, {"y_rad_per_nm", "rad/Nm"}};
  }
  void unit_motions(const Effect& effect, const Robot& /*robot*/, const ArmState& state,
                    std::vector<UnitMotion>& motions) const override {
    for (int axis = 0; axis < 2; ++axis) {
      motions.push_back({axis, effect.joint, 3 + axis, moment_nm(state, effect.joint)[axis]});
    }
  }
  std::vector<Effect> proposals(const Robot& robot, const Evidence& evidence) const override {
    std::vector<Effect> effects;
    if (!evidence.masses) return effects;
    const std::vector<ArmState> states = sampled_states(robot, evidence, 0.0);
    for (int joint = 0; joint < robot.chain.size(); ++joint) {
      const auto bends = [&](const ArmState& state) { return moment_nm(state, joint).head<2>().norm() > kNoLoad; };
      if (std::ranges::any_of(states, bends)) effects.push_back({.kind = "link_bending", .joint = joint});
    }
    return effects;
  }
  Needs needs(const Effect& /*effect*/, const Robot& /*robot*/) const override { return {.masses = true}; }
  std::string formula(const Effect& effect, const Robot& robot) const override {
    const std::string joint = std::to_string(effect.joint + 1);
    return write_equations(effect, robot,
                           {{"tilt_x" + joint, {{0, "M_x" + joint}}}, {"tilt_y" + joint, {{1, "M_y" + joint}}}});
  }
  std::string diagnosis(const Effect& effect, const Robot& /*robot*/) const override {
    return "The axis of joint " + std::to_string(effect.joint + 1) + " tilts by " + angle_words(effect.value(0)) +
           " about its x and " + angle_words(effect.value(1)) +
           " about its y per Nm of gravity's moment there: its bearing or the link before it bends.";
  }
};

}  // namespace

const EffectLaw& link_bending_law() {
  static const LinkBending law;
  return law;
}

}  // namespace demecal
