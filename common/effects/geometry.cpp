#include "effects/joint_words.hpp"
#include "effects/laws.hpp"
#include "effects/link_motion.hpp"

namespace demecal {
namespace {

struct Free {
  LinkParameter parameter;
  std::string symbol;
  std::string unit;
};

/// What of a link is free beside its joint's offset: d, a and alpha, beta in place of d between near-parallel axes; of
/// a prismatic joint, which has a direction but no place, two angles.
std::vector<Free> free_of(const Robot& robot, int joint) {
  const bool parallel = leads_between_parallels(robot.chain, joint);
  const Free beta{LinkParameter::beta, "beta", "rad"}, alpha{LinkParameter::alpha, "alpha", "rad"};
  if (!is_revolute(robot, joint)) return {parallel ? beta : Free{LinkParameter::theta, "theta", "rad"}, alpha};
  return {parallel ? beta : Free{LinkParameter::d, "d", "m"}, {LinkParameter::a, "a", "m"}, alpha};
}

/// A link that is not as drawn.
class Geometry final : public EffectLaw {
 public:
  std::string_view kind() const override { return "geometry"; }
  std::vector<CoefficientLabel> coefficients(const Effect& effect, const Robot& robot) const override {
    std::vector<CoefficientLabel> labels;
    for (const Free& free : free_of(robot, effect.joint)) labels.push_back({free.symbol + '_' + free.unit, free.unit});
    return labels;
  }
  void unit_motions(const Effect& effect, const Robot& robot, const ArmState& state,
                    std::vector<UnitMotion>& motions) const override {
    int coefficient = 0;
    for (const Free& free : free_of(robot, effect.joint)) {
      append_link_motion(robot.chain, effect.joint, state.joints()[effect.joint], free.parameter, coefficient++, 1.0,
                         motions);
    }
  }
  std::vector<Effect> proposals(const Robot& robot, const Evidence& /*evidence*/) const override {
    std::vector<Effect> effects;
    for (int joint = 0; joint < robot.chain.size(); ++joint) effects.push_back({.kind = "geometry", .joint = joint});
    return effects;
  }
  Needs needs(const Effect& /*effect*/, const Robot& /*robot*/) const override { return {}; }
  std::string formula(const Effect& effect, const Robot& robot) const override {
    std::vector<Equation> equations;
    for (const Free& free : free_of(robot, effect.joint)) {
      equations.push_back({'d' + free.symbol + std::to_string(effect.joint + 1), {{equations.size(), ""}}});
    }
    return write_equations(effect, robot, equations);
  }
  std::string diagnosis(const Effect& effect, const Robot& robot) const override {
    std::string amounts;
    std::size_t coefficient = 0;
    for (const Free& free : free_of(robot, effect.joint)) {
      const double value = effect.value(coefficient++);
      amounts += (amounts.empty() ? "" : ", ") + free.symbol + " by " +
                 (free.unit == "m" ? length_words(value) : angle_words(value));
    }
    return "Link " + std::to_string(effect.joint + 1) + " is not as drawn: " + amounts + '.';
  }
};

}  // namespace

const EffectLaw& geometry_law() {
  static const Geometry law;
  return law;
}

}  // namespace demecal
