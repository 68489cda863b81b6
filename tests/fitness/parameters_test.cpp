// The rules of the parameters: Table 6-1 keeps them, and each has a case that breaks it.
#include "fitness/parameters.hpp"

#include <gtest/gtest.h>

#include <functional>
#include <limits>

namespace demecal {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr double kInfinity = std::numeric_limits<double>::infinity();

struct Case {
  const char* key;
  const char* value;
  std::function<void(GpParameters&)> breaks;
};

TEST(Parameters, OfTheThesisKeepTheRules) {
  EXPECT_FALSE(find_fault(GpParameters{}));
}

TEST(Parameters, AtTheEdgesOfTheRulesAreAllowed) {
  GpParameters p;
  p.population_size = p.tournament_size = p.number_generations = p.invalid_attempts = 1;
  p.min_tree_depth = p.initial_max_tree_depth1 = p.initial_max_tree_depth2 = p.max_tree_depth = 15;
  p.crossover_rate = p.terminal_crossover_rate = 0.0;
  p.mutation_rate = p.terminal_mutation_rate = p.shrink_mutation_rate = 1.0;
  p.functions = {Primitive::sine};
  p.max_tree_nodes = 65535;
  EXPECT_FALSE(find_fault(p));
}

TEST(Parameters, ThatBreakARuleAreNamedWithKeyAndValue) {
  const std::vector<Case> cases{
      {"population_size", "0", [](GpParameters& p) { p.population_size = 0; }},
      {"number_generations", "0", [](GpParameters& p) { p.number_generations = 0; }},
      {"tournament_size", "0", [](GpParameters& p) { p.tournament_size = 0; }},
      {"tournament_size", "301", [](GpParameters& p) { p.tournament_size = 301; }},
      {"initial_max_tree_depth1", "0", [](GpParameters& p) { p.initial_max_tree_depth1 = 0; }},
      {"initial_max_tree_depth2", "-1", [](GpParameters& p) { p.initial_max_tree_depth2 = -1; }},
      {"max_tree_depth", "0", [](GpParameters& p) { p.max_tree_depth = 0; }},
      {"min_tree_depth", "0", [](GpParameters& p) { p.min_tree_depth = 0; }},
      {"invalid_attempts", "0", [](GpParameters& p) { p.invalid_attempts = 0; }},
      {"crossover_rate", "1.5", [](GpParameters& p) { p.crossover_rate = 1.5; }},
      {"mutation_rate", "-0.1", [](GpParameters& p) { p.mutation_rate = -0.1; }},
      {"terminal_crossover_rate", "2", [](GpParameters& p) { p.terminal_crossover_rate = 2.0; }},
      {"terminal_mutation_rate", "nan", [](GpParameters& p) { p.terminal_mutation_rate = kNan; }},
      {"shrink_mutation_rate", "inf", [](GpParameters& p) { p.shrink_mutation_rate = kInfinity; }},
      {"min_tree_depth", "4", [](GpParameters& p) { p.min_tree_depth = 4; }},
      {"initial_max_tree_depth1", "6", [](GpParameters& p) { p.initial_max_tree_depth1 = 6; }},
      {"initial_max_tree_depth2", "10", [](GpParameters& p) { p.initial_max_tree_depth2 = 10; }},
      {"max_tree_depth", "16", [](GpParameters& p) { p.max_tree_depth = 16; }},
      {"max_tree_nodes", "62", [](GpParameters& p) { p.max_tree_nodes = 62; }},
      {"max_tree_nodes", "-1", [](GpParameters& p) { p.max_tree_nodes = -1; }},
      {"functions", "[]", [](GpParameters& p) { p.functions.clear(); }},
      {"functions", "SIN", [](GpParameters& p) { p.functions.push_back(Primitive::sine); }},
      {"function_weights", "2",
       [](GpParameters& p) {
         p.function_weights = {1.0, 2.0};
       }},
      {"function_weights", "0", [](GpParameters& p) { p.function_weights.assign(p.functions.size(), 0.0); }},
      {"shared_functions", "17",
       [](GpParameters& p) {
         p.shared_functions.assign(17, {neutral_tree(), 0});
       }},
      {"shared_functions", "F2",
       [](GpParameters& p) {
         p.shared_functions = {{neutral_tree(), 0}, {neutral_tree(), 1}};
       }},
      {"shared_function_weight", "0", [](GpParameters& p) { p.shared_function_weight = 0.0; }},
      {"restart_after", "-1", [](GpParameters& p) { p.restart_after = -1; }},
      {"functions", "terminal", [](GpParameters& p) { p.functions.push_back(Primitive::variable); }},
      {"constants_lower", "-inf", [](GpParameters& p) { p.constants_lower = -kInfinity; }},
      {"constants_upper", "inf", [](GpParameters& p) { p.constants_upper = kInfinity; }},
      {"constants_lower", "1", [](GpParameters& p) { p.constants_lower = 1.0; }},
      {"constants_upper", "1e+308", [](GpParameters& p) { p.constants_lower = -1e308, p.constants_upper = 1e308; }},
  };
  for (const Case& one : cases) {
    GpParameters parameters;
    one.breaks(parameters);
    const auto fault = find_fault(parameters);
    ASSERT_TRUE(fault) << one.key << " = " << one.value;
    EXPECT_EQ(fault->key, one.key);
    EXPECT_EQ(fault->value, one.value) << one.key;
    EXPECT_EQ(fault->rule.rfind("must ", 0), 0u) << fault->rule;
  }
}

}  // namespace
}  // namespace demecal
