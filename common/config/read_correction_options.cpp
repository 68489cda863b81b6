#include "config/read_correction_options.hpp"

#include <limits>

#include "config/files.hpp"
#include "config/model_text.hpp"
#include "errors/input_error.hpp"
#include "expression/shared_function.hpp"
#include "expression/text.hpp"

namespace demecal {
namespace {

Tree read_formula(const YamlNode& node) {
  try {
    return parse(node.text());
  } catch (const InputError& error) {
    node.fail(error.what());
  }
}

SeedFormula read_seed(const YamlNode& node) {
  if (node.kind != YamlNode::Kind::map) return {SeedFormula::kEveryJoint, read_formula(node)};
  node.with_keys({"joint", "expression"});
  const auto joint = static_cast<int>(node.at("joint").whole_number(1, std::numeric_limits<int>::max()));
  return {joint - 1, read_formula(node.at("expression"))};
}

void append_corrections(const YamlNode& file, std::vector<SeedFormula>& seeds) {
  const CalibratedModel model = load_model(resolve(file.file, file.text()));
  for (std::size_t joint = 0; joint < model.robot.corrections.size(); ++joint) {
    const JointCorrection& correction = model.robot.corrections[joint];
    if (!correction.is_neutral()) seeds.push_back({static_cast<int>(joint), correction.formula()});
  }
}

constexpr std::int64_t kMostStages = 1000;

SharingOptions read_sharing(const YamlNode& node) {
  SharingOptions sharing;
  const auto most = static_cast<std::int64_t>(kMostSharedFunctions);
  if (const YamlNode* functions = node.find("shared_functions"))
    sharing.functions = static_cast<int>(functions->whole_number(0, most));
  if (const YamlNode* stages = node.find("function_stages"))
    sharing.stages = static_cast<int>(stages->whole_number(2, kMostStages));
  return sharing;
}

}  // namespace

CorrectionOptions read_correction_options(const YamlNode& node) {
  CorrectionOptions options;
  if (const YamlNode* largest = node.find("largest_correction_mrad")) options.largest_rad = 1e-3 * largest->positive();
  if (const YamlNode* formulas = node.find("seed_formulas")) {
    for (const YamlNode& formula : formulas->list()) options.seeds.push_back(read_seed(formula));
  }
  if (const YamlNode* models = node.find("seed_models")) {
    for (const YamlNode& file : models->list()) append_corrections(file, options.seeds);
  }
  options.sharing = read_sharing(node);
  return options;
}

}  // namespace demecal
