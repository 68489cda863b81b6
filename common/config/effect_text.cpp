#include "config/effect_text.hpp"

#include <sstream>

#include "config/yaml_text.hpp"

namespace demecal {
namespace {

/// "{name: 1, other: 2}" of the coefficients.
std::string by_name(const std::vector<CoefficientLabel>& labels, const std::vector<double>& values) {
  std::string text = "{";
  for (std::size_t i = 0; i < labels.size(); ++i) {
    text += (i == 0 ? "" : ", ") + labels[i].name + ": " + number_text(values[i]);
  }
  return text + "}";
}

std::string ranges_text(const MeasuredRanges& ranges, const Chain& chain) {
  std::string text = "{";
  for (const auto& [joint, range] : ranges) {
    const bool revolute = is_revolute(chain, joint);
    const double ends[] = {range.lower, range.upper};
    text += (text.size() > 1 ? ", q" : "q") + std::to_string(joint + 1) + (revolute ? "_rad: " : "_m: ") +
            yaml_numbers(ends);
  }
  return text + "}";
}

std::string effect_text(const Effect& effect, const Robot& robot) {
  const EffectLaw& law = law_of(effect);
  const std::vector<CoefficientLabel> labels = law.coefficients(effect, robot);
  std::ostringstream text;
  text << "  - kind: " << effect.kind << '\n';
  if (effect.joint >= 0) text << "    joint: " << effect.joint + 1 << '\n';
  if (!effect.form.empty()) text << "    form: " << effect.form << '\n';
  if (!effect.formula.empty()) {
    text << "    formula: " << yaml_text(to_string(effect.formula, symbolic_variables(robot.chain))) << '\n';
  }
  for (const auto& [name, value] : effect.settings) text << "    " << name << ": " << number_text(value) << '\n';
  for (std::size_t i = 0; i < labels.size(); ++i) {
    text << "    " << labels[i].name << ": " << number_text(effect.value(i)) << '\n';
  }
  if (!effect.standard_errors.empty()) {
    text << "    standard_errors: " << by_name(labels, effect.standard_errors) << '\n';
  }
  if (!effect.ranges.empty()) text << "    ranges: " << ranges_text(effect.ranges, robot.chain) << '\n';
  return text.str();
}

}  // namespace

std::string effects_text(const std::vector<Effect>& effects, const Robot& robot) {
  if (effects.empty()) return "effects: []\n";
  std::string text = "effects:\n";
  for (const Effect& effect : effects) text += effect_text(effect, robot);
  return text;
}

}  // namespace demecal
