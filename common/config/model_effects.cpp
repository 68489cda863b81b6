#include <algorithm>
#include <cstddef>
#include <map>
#include <memory>
#include <optional>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "closed_calibration/calibrated_model.hpp"
#include "config/model_file.hpp"
#include "data/data_set.hpp"
#include "data/text.hpp"
#include "effects/effect.hpp"
#include "errors/input_error.hpp"
#include "expression/text.hpp"
#include "expression/tree.hpp"
#include "kinematics/chain.hpp"
#include "parameters/posterior.hpp"
#include "yaml/yaml_node.hpp"
#include "yaml/yaml_text.hpp"

namespace demecal::inline config {
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

const EffectLaw& read_kind(const YamlNode& node) {
  std::vector<std::string> kinds;
  for (const EffectLaw* law : catalogue()) kinds.emplace_back(law->kind());
  const EffectLaw* law = node.kind == YamlNode::Kind::scalar ? find_law(node.scalar) : nullptr;
  if (law == nullptr) node.fail_choice(kinds);
  return *law;
}

std::string read_form(const YamlNode& node, const EffectLaw& law) {
  const std::vector<std::string> forms = law.forms();
  if (forms.empty()) node.fail("is not for a kind with one form only");
  if (std::find(forms.begin(), forms.end(), node.text()) == forms.end()) node.fail_choice(forms);
  return node.text();
}

Tree read_symbolic_formula(const YamlNode& node, const Chain& chain) {
  try {
    return parse(node.text(), symbolic_variables(chain));
  } catch (const InputError& fault) {
    node.fail("is no formula: " + fault.rule());
  }
}

double read_setting(const YamlNode& node, const Robot& robot) {
  if (node.name == "from") return static_cast<double>(node.whole_number(1, robot.chain.size()));
  const bool of_any_sign = node.name.starts_with("reference_") || node.name.starts_with("logged_") ||
                           node.name.starts_with("shortest_") || node.name.starts_with("at_");
  return of_any_sign ? node.number() : node.positive();
}

void read_settings(const YamlNode& node, const EffectLaw& law, const Robot& robot, Effect& effect) {
  for (const std::string& name : law.settings()) {
    if (const YamlNode* setting = node.find(name)) {
      effect.settings[name] = read_setting(*setting, robot);
    } else if (law.requires_setting(effect, name)) {
      node.at(name);
    }
  }
}

/// "q2_rad" or, of a prismatic joint, "q2_m".
MeasuredRanges read_ranges(const YamlNode& node, const Chain& chain) {
  std::vector<std::string> names;
  for (int joint = 0; joint < chain.size(); ++joint) {
    const bool revolute = is_revolute(chain, joint);
    names.push_back("q" + std::to_string(joint + 1) + (revolute ? "_rad" : "_m"));
  }
  node.with_keys(names);
  MeasuredRanges ranges;
  for (int joint = 0; joint < chain.size(); ++joint) {
    const YamlNode* range = node.find(names[static_cast<std::size_t>(joint)]);
    if (range == nullptr) continue;
    const auto [lower, upper] = range->range();
    ranges[joint] = {lower, upper};
  }
  return ranges;
}

/// The keys an item may have.
std::vector<std::string> keys_of(const EffectLaw& law, const std::vector<CoefficientLabel>& labels) {
  std::vector<std::string> keys = {"kind", "standard_errors", "ranges"};
  if (law.subject() == Subject::joint) keys.emplace_back("joint");
  if (!law.forms().empty()) keys.emplace_back("form");
  if (law.takes_formula()) keys.emplace_back("formula");
  for (std::string& name : law.settings()) keys.push_back(std::move(name));
  for (const CoefficientLabel& label : labels) keys.push_back(label.name);
  return keys;
}

std::vector<double> read_standard_errors(const YamlNode& node, const std::vector<CoefficientLabel>& labels) {
  std::vector<std::string> names;
  for (const CoefficientLabel& label : labels) names.push_back(label.name);
  node.with_keys(names);
  std::vector<double> errors;
  for (const std::string& name : names) errors.push_back(node.at(name).non_negative());
  return errors;
}

Effect read_effect(const YamlNode& node, const Robot& robot) {
  const EffectLaw& law = read_kind(node.at("kind"));
  Effect effect{.kind = std::string(law.kind())};
  if (law.subject() == Subject::joint) effect.joint = joint_at(node, "joint", robot.chain);
  if (const YamlNode* form = node.find("form")) effect.form = read_form(*form, law);
  if (law.takes_formula()) effect.formula = read_symbolic_formula(node.at("formula"), robot.chain);
  read_settings(node, law, robot, effect);
  const std::vector<CoefficientLabel> labels = law.coefficients(effect, robot);
  node.with_keys(keys_of(law, labels));
  for (const CoefficientLabel& label : labels) effect.values.push_back(node.at(label.name).number());
  if (const YamlNode* errors = node.find("standard_errors"))
    effect.standard_errors = read_standard_errors(*errors, labels);
  if (const YamlNode* ranges = node.find("ranges")) effect.ranges = read_ranges(*ranges, robot.chain);
  return effect;
}

}  // namespace

std::string effects_text(const std::vector<Effect>& effects, const Robot& robot) {
  if (effects.empty()) return "effects: []\n";
  std::string text = "effects:\n";
  for (const Effect& effect : effects) text += effect_text(effect, robot);
  return text;
}

std::vector<Effect> read_effects(const YamlNode& list, const Robot& robot) {
  std::vector<Effect> effects;
  for (const YamlNode& node : list.list()) effects.push_back(read_effect(node, robot));
  return effects;
}

namespace {

FleetNumber read_number(const YamlNode& node) {
  node.with_keys({"name", "mean", "standard_error", "spread"});
  return {node.at("name").text(), node.at("mean").number(), node.at("standard_error").non_negative(),
          node.at("spread").non_negative()};
}

FleetCurve read_curve(const YamlNode& node, const Chain& chain) {
  node.with_keys({"joint", "wave_deviations_rad"});
  FleetCurve curve{joint_at(node, "joint", chain), {}};
  for (const YamlNode& deviation : node.at("wave_deviations_rad").list())
    curve.wave_deviations_rad.push_back(deviation.non_negative());
  return curve;
}

}  // namespace

std::string fleet_text(const CalibratedModel& model) {
  if (!model.fleet) return {};
  std::string text =
      "# No calibrated robot: the mean of these, and how they are spread about it, in the units that names state "
      "(effects: SI)\nfleet:\n  robots:\n";
  for (const FleetMember& one : model.fleet->robots)
    text += "    - {file: " + yaml_text(one.file) + ", job: " + yaml_text(one.job) +
            ", data: " + yaml_text(one.data_name) + ", data_sha256: " + yaml_text(one.data_sha256) + "}\n";
  text += model.fleet->numbers.empty() ? "  numbers: []\n" : "  numbers:\n";
  for (const FleetNumber& one : model.fleet->numbers)
    text += "    - {name: " + yaml_text(one.name) + ", mean: " + number_text(one.mean) +
            ", standard_error: " + number_text(one.standard_error) + ", spread: " + number_text(one.spread) + "}\n";
  text += model.fleet->curves.empty() ? "  curves: []\n" : "  curves:\n";
  for (const FleetCurve& one : model.fleet->curves)
    text += "    - {joint: " + std::to_string(one.joint + 1) +
            ", wave_deviations_rad: " + yaml_numbers(one.wave_deviations_rad) + "}\n";
  return text;
}

void read_fleet(const YamlNode& file, CalibratedModel& model) {
  const YamlNode* node = file.find("fleet");
  if (node == nullptr) return;
  node->with_keys({"robots", "numbers", "curves"});
  FleetOrigin fleet;
  for (const YamlNode& one : node->at("robots").list()) {
    one.with_keys({"file", "job", "data", "data_sha256"});
    fleet.robots.push_back(
        {one.at("file").text(), one.at("job").text(), one.at("data").text(), one.at("data_sha256").text()});
  }
  for (const YamlNode& one : node->at("numbers").list()) fleet.numbers.push_back(read_number(one));
  for (const YamlNode& one : node->at("curves").list()) fleet.curves.push_back(read_curve(one, model.nominal.chain));
  if (!model.posterior || model.posterior->ids.size() != fleet.numbers.size())
    node->fail("", "must have the numbers of the posterior, in its order: make the file anew by `demecal fleet`");
  model.fleet = std::move(fleet);
}

}  // namespace demecal::inline config
