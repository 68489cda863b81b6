// The parameters of genetic programming, by the names of the thesis's Table 5-8 with the values of Table 6-1.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "expression/shared_function.hpp"
#include "primitives/primitive.hpp"

namespace demecal::inline fitness {

/// What max_tree_depth may be at most.
inline constexpr int kDeepestTree = 15;

/// Whether the constants of formulas are fitted, and what of it is inherited (thesis 7.1 v): with Lamarck the fitted
/// constants, with Baldwin only what fitness they made possible.
enum class ConstantPolicy : std::uint8_t { none, lamarckian, baldwin };

struct GpParameters {
  int population_size = 300;
  int number_generations = 200;  ///< thesis 6.3: 200 for direct learning
  int tournament_size = 5;
  int initial_max_tree_depth1 = 3;  ///< where the ramp of half-and-half begins
  int initial_max_tree_depth2 = 5;  ///< where it ends
  int max_tree_depth = 9;
  int min_tree_depth = 3;     ///< of trees made by GROW and by mutation
  int max_tree_nodes = 0;     ///< of every tree; 0: no limit but max_tree_depth
  int invalid_attempts = 21;  ///< tries at a valid offspring before the parents are reproduced
  double crossover_rate = 0.8;
  double mutation_rate = 0.2;
  double terminal_crossover_rate = 0.2;  ///< probability that a crossover point is a terminal
  double terminal_mutation_rate = 0.3;   ///< probability that a mutation point is a terminal
  double shrink_mutation_rate = 0.2;     ///< probability that a mutation makes the subtree shallower
  std::vector<Primitive> functions{Primitive::add,  Primitive::subtract, Primitive::multiply, Primitive::divide,
                                   Primitive::sine, Primitive::cosine,   Primitive::sign,     Primitive::square_root};
  double constants_lower = 0.0;  ///< range of the ephemeral constant
  double constants_upper = 1.0;
  ConstantPolicy constants = ConstantPolicy::none;
  int constant_steps = 10;                 ///< of Levenberg and Marquardt, on each formula that is fitted
  double constant_share = 1.0;             ///< of each generation that is fitted: its fittest new formulas
  bool linear_scaling = false;             ///< whether formulas are judged by the best a + b * formula
  bool no_duplicates = false;              ///< whether offspring that a generation holds already are varied again
  int restart_after = 0;                   ///< epochs without gain before an island's population begins anew; 0: never
  std::vector<double> function_weights{};  ///< how often each function is drawn beside the others; empty: all alike
  std::vector<SharedFunction> shared_functions{};  ///< of which calls are drawn beside the functions
  double shared_function_weight = 1.0;             ///< how often each of them is, where a function's weight is 1

  bool operator==(const GpParameters&) const = default;
};

/// A parameter that breaks a rule: its key in lower case, its value and the rule, for a sentence to the user.
struct ParameterFault {
  std::string key;
  std::string value;
  std::string rule;
};

/// The first broken rule: counts positive, rates within 0 to 1, min_tree_depth <= initial_max_tree_depth1 <=
/// initial_max_tree_depth2 <= max_tree_depth <= 15, max_tree_nodes 0 or enough for every tree of
/// initial_max_tree_depth2, tournament no larger than the population, at least one function, no
/// function twice, no weights of functions or one for each, finite and above 0, at most kMostSharedFunctions that are
/// shared, each sound, with a weight that is finite and above 0, constants_lower < constants_upper and
/// both finite, a known policy for constants. Nothing where all hold.
std::optional<ParameterFault> find_fault(const GpParameters& parameters);

}  // namespace demecal::inline fitness
