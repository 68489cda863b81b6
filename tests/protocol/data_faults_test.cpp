// A run's data as received: what is accepted and what is refused.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>

#include "protocol/faults.hpp"
#include "small_run.hpp"

namespace demecal {
namespace {

struct DataSpoiling {
  const char* what;
  std::function<void(CalibrationData&)> spoil;
};

/// F(c1, a1) = SIN(c1 * a1).
SharedFunction sine_of_multiple() {
  return {apply(Primitive::sine, apply(Primitive::multiply, variable_tree(0), variable_tree(1))), 1};
}

const std::vector<DataSpoiling>& spoilings() {
  static const std::vector<DataSpoiling> all{
      {"no run", [](auto& d) { d.run = 0; }},
      {"parameter out of its range", [](auto& d) { d.parameters.crossover_rate = 1.5; }},
      {"population of none", [](auto& d) { d.parameters.population_size = 0; }},
      {"more individuals than the limit", [](auto& d) { d.parameters.population_size = kMostIndividuals + 1; }},
      {"more generations than the limit", [](auto& d) { d.parameters.number_generations = kMostGenerations + 1; }},
      {"more attempts than the limit", [](auto& d) { d.parameters.invalid_attempts = kMostAttempts + 1; }},
      {"more rows than the limit",
       [](auto& d) {
         const std::vector<double> column(kMostRows + 1);
         d.tables[0] = TrainingTable{{column}, column, column};
       }},
      {"no joints",
       [](auto& d) {
         d.archipelago.joints.clear();
         d.tables.clear();
       }},
      {"joints descending",
       [](auto& d) {
         d.archipelago.joints = {2, 0};
       }},
      {"a joint twice",
       [](auto& d) {
         d.archipelago.joints = {2, 2};
       }},
      {"joint too high",
       [](auto& d) {
         d.archipelago.joints = {0, kMostJoints};
       }},
      {"no demes", [](auto& d) { d.archipelago.demes_per_joint = 0; }},
      {"too many demes", [](auto& d) { d.archipelago.demes_per_joint = kMostDemes + 1; }},
      {"unknown topology", [](auto& d) { d.archipelago.topology = static_cast<Topology>(9); }},
      {"no migration interval", [](auto& d) { d.archipelago.migration_interval = 0; }},
      {"more migrants than individuals", [](auto& d) { d.archipelago.migrants = 21; }},
      {"a table too few", [](auto& d) { d.tables.pop_back(); }},
      {"no rows",
       [](auto& d) {
         d.tables[0] = TrainingTable{{{}}, {}, {}};
       }},
      {"no variables", [](auto& d) { d.tables[1].variables.clear(); }},
      {"too many variables", [](auto& d) { d.tables[1].variables.resize(256, d.tables[1].target); }},
      {"a variable's column too short", [](auto& d) { d.tables[1].variables[0].pop_back(); }},
      {"an infinite variable", [](auto& d) { d.tables[0].variables[0][3] = HUGE_VAL; }},
      {"a target that is no number", [](auto& d) { d.tables[0].target[0] = std::nan(""); }},
      {"a weight too few", [](auto& d) { d.tables[0].weight.pop_back(); }},
      {"a weight below 0", [](auto& d) { d.tables[0].weight[0] = -0.1; }},
      {"an unknown loss", [](auto& d) { d.tables[0].loss = static_cast<Loss>(7); }},
      {"a seed that is no formula", [](auto& d) { d.tables[0].seeds = {Tree{}}; }},
      {"a seed of a variable that is not there", [](auto& d) { d.tables[0].seeds = {variable_tree(1)}; }},
      {"more seeds than individuals", [](auto& d) { d.tables[0].seeds.assign(21, variable_tree(0)); }},
      {"a limit below 0", [](auto& d) { d.tables[0].limit = -1.0; }},
      {"a limit that is no number", [](auto& d) { d.tables[0].limit = std::nan(""); }},
      {"a limit on formulas of several variables",
       [](auto& d) {
         d.tables[0].variables.push_back(d.tables[0].target);
         d.tables[0].limit = 3.0;
       }},
      {"more shared functions than the limit",
       [](auto& d) { d.parameters.shared_functions.assign(kMostSharedFunctions + 1, sine_of_multiple()); }},
      {"a shared function that is no formula", [](auto& d) { d.parameters.shared_functions = {SharedFunction{}}; }},
      {"a shared function longer than the limit",
       [](auto& d) {
         Tree body = variable_tree(0);
         while (body.size() <= kLongestBody) body = apply(Primitive::sine, body);
         d.parameters.shared_functions = {{body, 0}};
       }},
      {"a shared function without an argument",
       [](auto& d) {
         d.parameters.shared_functions = {{sine_of_multiple().body, 2}};
       }},
      {"a weight of shared functions that is no number", [](auto& d) { d.parameters.shared_function_weight = 0.0; }},
      {"an unknown replacement", [](auto& d) { d.archipelago.replacement = static_cast<Replacement>(2); }},
      {"a spread above 1", [](auto& d) { d.archipelago.spread = 1.5; }},
      {"a weight above 1", [](auto& d) { d.tables[0].weight[11] = 1.1; }},
  };
  return all;
}

TEST(DataFaults, ASoundRunHasNone) {
  EXPECT_EQ(find_fault(small_run()), std::nullopt);
}

TEST(DataFaults, ARunWithSharedFunctionsHasNone) {
  CalibrationData data = small_run();
  data.parameters.shared_functions.assign(kMostSharedFunctions, sine_of_multiple());
  EXPECT_EQ(find_fault(data), std::nullopt);
}

TEST(DataFaults, EverySpoiltFieldIsFound) {
  for (const auto& [what, spoil] : spoilings()) {
    CalibrationData data = small_run();
    spoil(data);
    EXPECT_NE(find_fault(data), std::nullopt) << what;
  }
}

}  // namespace
}  // namespace demecal
