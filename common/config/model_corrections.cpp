#include "config/model_file.hpp"

#include <cmath>
#include <cstddef>
#include <span>
#include <sstream>
#include <vector>

#include "calibration/calibration.hpp"
#include "calibration/shared_functions.hpp"
#include "errors/input_error.hpp"
#include "expression/bound.hpp"
#include "expression/shared_function.hpp"
#include "expression/text.hpp"
#include "expression/tree.hpp"
#include "prediction/corrected_robot.hpp"
#include "yaml/yaml_text.hpp"

namespace demecal::inline config {
namespace {

std::string correction_text(const JointSummary& summary, const JointCorrection& correction,
                            const KnownFunctions& functions) {
  std::ostringstream text;
  text << "  - joint: " << summary.joint + 1 << '\n';
  if (!summary.kept) {
    text << "    expression: theta-theta\n";
    if (!summary.note.empty()) text << "    note: " << yaml_text(summary.note) << '\n';
    return text.str();
  }
  const double range[] = {correction.range_rad().lower, correction.range_rad().upper};
  text << "    expression: " << yaml_text(to_string(correction.formula())) << '\n';
  if (const FoldedFormula calling = folded_correction(correction, functions); !calling.calls.empty())
    text << "    with_functions: " << yaml_text(to_string(calling)) << '\n';
  text << "    range_rad: " << yaml_numbers(range) << '\n';
  if (correction.branch().wraps)
    text << "    branch_centre_rad: " << number_text(correction.branch().centre_rad) << '\n';
  if (std::isfinite(summary.bound_rad)) text << "    bound_rad: " << number_text(summary.bound_rad) << '\n';
  text << "    discontinuities_rad: " << yaml_numbers(summary.discontinuities_rad) << '\n';
  return text.str();
}

Tree read_formula(const YamlNode& node, std::span<const SharedFunction> functions = {}) {
  try {
    return parse(node.text(), theta_only(), functions);
  } catch (const InputError& error) {
    node.fail(error.what());
  }
}

/// For people: that it is what the expression says is all that is asked of it.
void check_calls(const YamlNode& node, const Tree& formula, const CalibratedModel& model) {
  if (!model.functions) node.fail("calls functions that the model does not define");
  if (depth(formula) > kDeepestFolded) node.fail("stands for a formula that is too deep for calls");
  if (in_order(read_formula(node, *model.functions)) != in_order(formula))
    node.fail("is not the formula that `expression` is");
}

/// Reads one entry of `corrections` into summary and correction.
JointCorrection read_correction(const YamlNode& node, const CalibratedModel& model, JointSummary& summary) {
  node.with_keys({"joint", "expression", "with_functions", "range_rad", "branch_centre_rad", "bound_rad",
                  "discontinuities_rad", "note"});
  if (const YamlNode* note = node.find("note")) summary.note = note->text();
  const Tree formula = read_formula(node.at("expression"));
  summary.kept = formula != neutral_tree();
  if (const YamlNode* calls = node.find("with_functions")) check_calls(*calls, formula, model);
  if (!summary.kept) return {};
  if (const YamlNode* bound = node.find("bound_rad")) summary.bound_rad = bound->non_negative();
  if (const YamlNode* jumps = node.find("discontinuities_rad")) summary.discontinuities_rad = jumps->numbers();
  AngleBranch branch;
  if (const YamlNode* centre = node.find("branch_centre_rad")) branch = {true, centre->number()};
  const auto [lower, upper] = node.at("range_rad").range();
  return {formula, branch, {lower, upper}};
}

}  // namespace

std::string functions_text(const CalibratedModel& model) {
  if (!model.functions) return {};
  std::ostringstream text;
  text << "shared_functions:" << (model.functions->empty() ? " []\n" : "\n");
  for (std::size_t i = 0; i < model.functions->size(); ++i) {
    text << "  - {definition: " << yaml_text(definition_text((*model.functions)[i], i)) << ", joints: [";
    const std::vector<int> joints = joints_calling(model.robot, *model.functions, i);
    for (std::size_t k = 0; k < joints.size(); ++k) text << (k == 0 ? "" : ", ") << joints[k] + 1;
    text << "]}\n";
  }
  return text.str();
}

std::string corrections_text(const CalibratedModel& model) {
  std::string text = "corrections:\n";
  for (const JointSummary& summary : model.joints) {
    const JointCorrection& correction = model.robot.corrections[static_cast<std::size_t>(summary.joint)];
    text += correction_text(summary, correction, model.functions);
  }
  return text;
}

KnownFunctions read_functions(const YamlNode* list) {
  if (list == nullptr) return std::nullopt;
  std::vector<SharedFunction> functions;
  for (const YamlNode& entry : list->list()) {
    entry.with_keys({"definition", "joints"});
    const YamlNode& definition = entry.at("definition");
    if (functions.size() == kMostSharedFunctions) entry.fail("", "is one function too many");
    try {
      functions.push_back(parse_definition(definition.text(), functions.size()));
    } catch (const InputError& error) {
      definition.fail(error.what());
    }
  }
  return functions;
}

void read_corrections(const YamlNode& list, CalibratedModel& model) {
  const int joints = model.robot.chain.size();
  model.robot.corrections.assign(static_cast<std::size_t>(joints), {});
  model.joints.resize(static_cast<std::size_t>(joints));
  for (int joint = 0; joint < joints; ++joint) model.joints[static_cast<std::size_t>(joint)].joint = joint;
  for (const YamlNode& entry : list.list()) {
    const auto joint = static_cast<std::size_t>(entry.at("joint").whole_number(1, joints) - 1);
    model.robot.corrections[joint] = read_correction(entry, model, model.joints[joint]);
  }
}

}  // namespace demecal::inline config
