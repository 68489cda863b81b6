// What is wrong with a joint outside the catalogue: a formula that evolution found.
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "data/data_set.hpp"
#include "effects/arm_state.hpp"
#include "effects/effect.hpp"
#include "effects/law_terms.hpp"
#include "effects/symbolic_state.hpp"
#include "errors/check.hpp"
#include "expression/evaluate.hpp"
#include "expression/text.hpp"
#include "expression/tree.hpp"
#include "kinematics/chain.hpp"
#include "primitives/primitive.hpp"
#include "symbolic/algebra.hpp"

namespace demecal::inline effects {
namespace {

constexpr int kCircumstances = 3;  // tau, s, T: behind the joints

bool mentions(const Tree& formula, int variable) {
  return std::ranges::any_of(
      formula, [&](const Node& node) { return node.primitive == Primitive::variable && node.variable == variable; });
}

bool is_wave(const Effect& effect) {
  return effect.form == "wave";
}

/// The formula with its variables counted anew, of those alone that it speaks of, and what they stand for.
struct UsedFormula {
  Tree formula;
  std::vector<Expression> arguments;
};

UsedFormula used_formula(const SymbolicWriter& writer) {
  const std::size_t joints = writer.state.joints.size();
  UsedFormula result{writer.effect.formula, {}};
  std::map<std::uint8_t, std::uint8_t> places;
  for (const Node& node : result.formula) {
    if (node.primitive == Primitive::variable) places.try_emplace(node.variable, 0);
  }
  for (auto& [variable, place] : places) {
    place = static_cast<std::uint8_t>(result.arguments.size());
    result.arguments.push_back(variable < joints        ? writer.joint(variable)
                               : variable == joints     ? writer.torque(writer.effect.joint)
                               : variable == joints + 1 ? writer.state.approach(writer.effect.joint)
                                                        : writer.warming());
  }
  for (Node& node : result.formula) {
    if (node.primitive == Primitive::variable) node.variable = places.at(node.variable);
  }
  return result;
}

constexpr const char* kSymbolic = "symbolic";

/// An error of a joint outside the catalogue: a formula and its size or, as a wave, the angle that a formula gives, the
/// size and the phase.
class SymbolicLaw final : public EffectLaw {
 public:
  std::string_view kind() const override { return kSymbolic; }
  std::vector<CoefficientLabel> coefficients(const Effect& effect, const Robot& robot) const override {
    if (is_wave(effect))
      return {motion_label(robot, effect.joint, "cosine"), motion_label(robot, effect.joint, "sine")};
    return {motion_label(robot, effect.joint, "scale")};
  }
  void unit_motions(const Effect& effect, const Robot& robot, const ArmState& state,
                    std::vector<UnitMotion>& motions) const override {
    DEMECAL_CHECK(is_valid(effect.formula, robot.chain.size() + kCircumstances), effect.formula.size() << " nodes");
    std::vector<double> values(state.joints().begin(), state.joints().end());
    values.insert(values.end(), {state.torque(robot.chain, effect.joint), state.approach(effect.joint),
                                 warming_kelvin(effect, state.stop)});
    const double value = evaluate(effect.formula, values);
    append_joint_motion(robot, effect.joint, 0, is_wave(effect) ? std::cos(value) : value, motions);
    if (is_wave(effect)) append_joint_motion(robot, effect.joint, 1, std::sin(value), motions);
  }
  std::vector<Effect> proposals(const Robot& /*robot*/, const Evidence& /*evidence*/) const override { return {}; }
  Needs needs(const Effect& effect, const Robot& robot) const override {
    const int n = robot.chain.size();
    return {.approach = mentions(effect.formula, n + 1),
            .temperature = mentions(effect.formula, n + 2),
            .masses = mentions(effect.formula, n)};
  }
  std::string formula(const Effect& effect, const Robot& robot) const override {
    const std::string text = '(' + formula_text(effect, robot) + ')';
    if (is_wave(effect)) return write_joint_equation(effect, robot, {{0, "COS" + text}, {1, "SIN" + text}});
    return write_joint_equation(effect, robot, {{0, text}});
  }
  std::string diagnosis(const Effect& effect, const Robot& robot) const override {
    const std::string start = joint_name(effect.joint) + " errs as no effect of the catalogue does: by ";
    if (!is_wave(effect))
      return start + motion_text(robot, effect.joint, effect.value(0)) + " times " + formula_text(effect, robot) + '.';
    const double phase = std::atan2(-effect.value(1), effect.value(0));
    return start + motion_text(robot, effect.joint, std::hypot(effect.value(0), effect.value(1))) + " times COS(" +
           formula_text(effect, robot) + (phase < 0 ? " - " : " + ") + rounded_text(std::abs(phase)) + ").";
  }
  std::vector<std::string> settings() const override { return {"reference_celsius"}; }
  std::vector<std::string> forms() const override { return {"formula", "wave"}; }
  bool requires_setting(const Effect& /*effect*/, const std::string& /*name*/) const override { return false; }
  bool takes_formula() const override { return true; }
  void append_symbolic_motions(SymbolicWriter& writer) const override {
    const UsedFormula used = used_formula(writer);
    const Expression value = used.arguments.empty()
                                 ? writer.constant(evaluate(used.formula, {}))
                                 : writer.state.algebra().formula(writer.name, used.formula, used.arguments);
    if (is_wave(writer.effect)) return writer.append_wave(value);
    writer.append_joint(0, value);
  }
  std::vector<int> ranged_joints(const Effect& effect, const Robot& robot) const override {
    std::vector<int> joints;
    for (int joint = 0; joint < robot.chain.size(); ++joint) {
      if (mentions(effect.formula, joint)) joints.push_back(joint);
    }
    return joints;
  }

 private:
  static std::string formula_text(const Effect& effect, const Robot& robot) {
    return to_string(effect.formula, symbolic_variables(robot.chain));
  }
};

}  // namespace

std::string_view symbolic_kind() {
  return kSymbolic;
}

bool is_symbolic(const Effect& effect) {
  return effect.kind == kSymbolic;
}

Effect symbolic_effect(int joint, const std::string& form) {
  return {.kind = kSymbolic, .joint = joint, .form = form};
}

VariableNames symbolic_variables(const Chain& chain) {
  VariableNames names;
  for (int joint = 0; joint < chain.size(); ++joint) names.push_back(joint_symbol(joint));
  names.insert(names.end(), {"tau", "s", "T"});
  return names;
}

const EffectLaw& symbolic_law() {
  static const SymbolicLaw law;
  return law;
}

}  // namespace demecal::inline effects
