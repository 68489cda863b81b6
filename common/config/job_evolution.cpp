#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <tuple>
#include <vector>

#include "calibration/job.hpp"
#include "closed_calibration/calibrated_model.hpp"
#include "config/job_file.hpp"
#include "config/model_file.hpp"
#include "errors/input_error.hpp"
#include "expression/shared_function.hpp"
#include "expression/text.hpp"
#include "expression/tree.hpp"
#include "fitness/parameters.hpp"
#include "prediction/corrected_robot.hpp"
#include "primitives/primitive.hpp"
#include "yaml/files.hpp"
#include "yaml/yaml_node.hpp"

namespace demecal::inline config {
namespace {

struct CountKey {
  std::string_view key;
  int GpParameters::*value;
};
constexpr std::array<CountKey, 11> kCounts{{{"population_size", &GpParameters::population_size},
                                            {"number_generations", &GpParameters::number_generations},
                                            {"tournament_size", &GpParameters::tournament_size},
                                            {"initial_max_tree_depth1", &GpParameters::initial_max_tree_depth1},
                                            {"initial_max_tree_depth2", &GpParameters::initial_max_tree_depth2},
                                            {"max_tree_depth", &GpParameters::max_tree_depth},
                                            {"max_tree_nodes", &GpParameters::max_tree_nodes},
                                            {"min_tree_depth", &GpParameters::min_tree_depth},
                                            {"invalid_attempts", &GpParameters::invalid_attempts},
                                            {"constant_steps", &GpParameters::constant_steps},
                                            {"restart_after", &GpParameters::restart_after}}};

struct RateKey {
  std::string_view key;
  double GpParameters::*value;
};
constexpr std::array<RateKey, 6> kRates{{{"crossover_rate", &GpParameters::crossover_rate},
                                         {"mutation_rate", &GpParameters::mutation_rate},
                                         {"terminal_crossover_rate", &GpParameters::terminal_crossover_rate},
                                         {"terminal_mutation_rate", &GpParameters::terminal_mutation_rate},
                                         {"shrink_mutation_rate", &GpParameters::shrink_mutation_rate},
                                         {"constant_share", &GpParameters::constant_share}}};

std::vector<std::string> known_keys() {
  std::vector<std::string> keys{
      "functions",        "constants_range",         "constants",     "linear_scaling", "no_duplicates",
      "function_weights", "largest_correction_mrad", "seed_formulas", "seed_models",    "shared_functions",
      "function_stages",  "shared_function_weight"};
  for (const CountKey& count : kCounts) keys.emplace_back(count.key);
  for (const RateKey& rate : kRates) keys.emplace_back(rate.key);
  return keys;
}

Primitive read_primitive(const YamlNode& symbol) {
  std::vector<std::string> symbols;
  for (const PrimitiveTraits& known : kPrimitives) {
    if (known.arity == 0) continue;
    if (known.symbol == symbol.text()) return known.primitive;
    symbols.emplace_back(known.symbol);
  }
  symbol.fail_choice(symbols);
}

/// The node that a parameter was read from, or the map where it kept its default.
const YamlNode& faulty_node(const ParameterFault& fault, const YamlNode& node) {
  const bool constants = fault.key.starts_with("constants_");
  const YamlNode* found = node.find(constants ? "constants_range" : fault.key);
  return found ? *found : node;
}

void check_together(const GpParameters& parameters, const YamlNode& node) {
  const auto fault = find_fault(parameters);
  if (!fault) return;
  const YamlNode& source = faulty_node(*fault, node);
  const bool named = source.name == fault->key;
  source.fail(fault->value, named ? fault->rule : "(" + fault->key + ") " + fault->rule);
}

Tree read_seed_formula(const YamlNode& node) {
  try {
    return parse(node.text());
  } catch (const InputError& error) {
    node.fail(error.what());
  }
}

SeedFormula read_seed(const YamlNode& node) {
  if (node.kind != YamlNode::Kind::map) return {SeedFormula::kEveryJoint, read_seed_formula(node)};
  node.with_keys({"joint", "expression"});
  const auto joint = static_cast<int>(node.at("joint").whole_number(1, std::numeric_limits<int>::max()));
  return {joint - 1, read_seed_formula(node.at("expression"))};
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

GpParameters read_gp(const YamlNode& node) {
  node.with_keys(known_keys());
  GpParameters parameters;
  for (const auto& [key, value] : kCounts) {
    if (const YamlNode* found = node.find(key)) {
      parameters.*value =
          static_cast<int>(found->whole_number(std::numeric_limits<int>::min(), std::numeric_limits<int>::max()));
    }
  }
  for (const auto& [key, value] : kRates) {
    if (const YamlNode* found = node.find(key)) parameters.*value = found->number();
  }
  if (const YamlNode* functions = node.find("functions")) {
    parameters.functions.clear();
    for (const YamlNode& symbol : functions->list()) parameters.functions.push_back(read_primitive(symbol));
  }
  if (const YamlNode* range = node.find("constants_range")) {
    std::tie(parameters.constants_lower, parameters.constants_upper) = range->range();
  }
  if (const YamlNode* constants = node.find("constants")) {
    parameters.constants = constants->one_of<ConstantPolicy>({{"none", ConstantPolicy::none},
                                                              {"lamarckian", ConstantPolicy::lamarckian},
                                                              {"baldwin", ConstantPolicy::baldwin}});
  }
  if (const YamlNode* weights = node.find("function_weights")) parameters.function_weights = weights->numbers();
  if (const YamlNode* weight = node.find("shared_function_weight"))
    parameters.shared_function_weight = weight->number();
  if (const YamlNode* none = node.find("no_duplicates")) parameters.no_duplicates = none->boolean();
  if (const YamlNode* scaling = node.find("linear_scaling")) parameters.linear_scaling = scaling->boolean();
  check_together(parameters, node);
  return parameters;
}

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

}  // namespace demecal::inline config
