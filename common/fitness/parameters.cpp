#include "fitness/parameters.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstddef>
#include <iterator>

namespace demecal::inline fitness {
namespace {

template <class Number>
std::string format_number(Number number) {
  char buffer[32];
  const auto result = std::to_chars(std::begin(buffer), std::end(buffer), number);
  return std::string(buffer, result.ptr);
}

struct Count {
  const char* key;
  int value;
};
struct Rate {
  const char* key;
  double value;
};

std::optional<ParameterFault> count_fault(const GpParameters& p) {
  const Count counts[]{{"population_size", p.population_size},
                       {"number_generations", p.number_generations},
                       {"tournament_size", p.tournament_size},
                       {"initial_max_tree_depth1", p.initial_max_tree_depth1},
                       {"initial_max_tree_depth2", p.initial_max_tree_depth2},
                       {"max_tree_depth", p.max_tree_depth},
                       {"min_tree_depth", p.min_tree_depth},
                       {"invalid_attempts", p.invalid_attempts},
                       {"constant_steps", p.constant_steps}};
  for (const auto& [key, value] : counts)
    if (value < 1) return ParameterFault{key, format_number(value), "must be at least 1"};
  return std::nullopt;
}

std::optional<ParameterFault> rate_fault(const GpParameters& p) {
  const Rate rates[]{{"crossover_rate", p.crossover_rate},
                     {"mutation_rate", p.mutation_rate},
                     {"terminal_crossover_rate", p.terminal_crossover_rate},
                     {"terminal_mutation_rate", p.terminal_mutation_rate},
                     {"shrink_mutation_rate", p.shrink_mutation_rate},
                     {"constant_share", p.constant_share}};
  for (const auto& [key, value] : rates)
    if (!(value >= 0.0 && value <= 1.0)) return ParameterFault{key, format_number(value), "must lie within 0 to 1"};
  return std::nullopt;
}

std::optional<ParameterFault> depth_fault(const GpParameters& p) {
  if (p.min_tree_depth > p.initial_max_tree_depth1)
    return ParameterFault{"min_tree_depth", format_number(p.min_tree_depth), "must not exceed initial_max_tree_depth1"};
  if (p.initial_max_tree_depth1 > p.initial_max_tree_depth2)
    return ParameterFault{"initial_max_tree_depth1", format_number(p.initial_max_tree_depth1),
                          "must not exceed initial_max_tree_depth2"};
  if (p.initial_max_tree_depth2 > p.max_tree_depth)
    return ParameterFault{"initial_max_tree_depth2", format_number(p.initial_max_tree_depth2),
                          "must not exceed max_tree_depth"};
  if (p.max_tree_depth > kDeepestTree)
    return ParameterFault{"max_tree_depth", format_number(p.max_tree_depth),
                          "must be at most " + format_number(kDeepestTree)};
  return std::nullopt;
}

std::optional<ParameterFault> nodes_fault(const GpParameters& p) {
  const int largest_first = (2 << p.initial_max_tree_depth2) - 1;
  if (p.max_tree_nodes != 0 && p.max_tree_nodes < largest_first)
    return ParameterFault{"max_tree_nodes", format_number(p.max_tree_nodes),
                          "must be 0 (no limit) or at least " + format_number(largest_first) +
                              ", the nodes of a full tree of initial_max_tree_depth2"};
  return std::nullopt;
}

std::optional<ParameterFault> function_fault(const std::vector<Primitive>& functions) {
  if (functions.empty()) return ParameterFault{"functions", "[]", "must name at least one function"};
  for (auto function = functions.begin(); function != functions.end(); ++function) {
    if (arity(*function) == 0) return ParameterFault{"functions", "terminal", "must name functions only"};
    if (std::find(functions.begin(), function, *function) != function)
      return ParameterFault{"functions", std::string(traits(*function).symbol), "must name no function twice"};
  }
  return std::nullopt;
}

std::optional<ParameterFault> weights_fault(const GpParameters& p) {
  const auto is_weight = [](double weight) { return weight > 0.0 && std::isfinite(weight); };
  for (const double weight : p.function_weights)
    if (!is_weight(weight))
      return ParameterFault{"function_weights", format_number(weight), "must be finite and above 0"};
  if (!p.function_weights.empty() && p.function_weights.size() != p.functions.size())
    return ParameterFault{"function_weights", format_number(p.function_weights.size()),
                          "must be as many as the functions: " + format_number(p.functions.size())};
  return std::nullopt;
}

std::optional<ParameterFault> shared_fault(const GpParameters& p) {
  const std::size_t count = p.shared_functions.size();
  if (count > kMostSharedFunctions)
    return ParameterFault{"shared_functions", format_number(count),
                          "must be at most " + format_number(kMostSharedFunctions)};
  for (std::size_t i = 0; i < count; ++i)
    if (const auto fault = find_fault(p.shared_functions[i]))
      return ParameterFault{"shared_functions", name_of_function(i), *fault};
  if (!(p.shared_function_weight > 0.0 && std::isfinite(p.shared_function_weight)))
    return ParameterFault{"shared_function_weight", format_number(p.shared_function_weight),
                          "must be finite and above 0"};
  return std::nullopt;
}

std::optional<ParameterFault> constants_fault(const GpParameters& p) {
  if (p.constants > ConstantPolicy::baldwin)
    return ParameterFault{"constants", format_number(static_cast<int>(p.constants)), "must be a known policy"};
  if (!std::isfinite(p.constants_lower))
    return ParameterFault{"constants_lower", format_number(p.constants_lower), "must be finite"};
  if (!std::isfinite(p.constants_upper))
    return ParameterFault{"constants_upper", format_number(p.constants_upper), "must be finite"};
  if (!(p.constants_lower < p.constants_upper))
    return ParameterFault{"constants_lower", format_number(p.constants_lower), "must be below constants_upper"};
  if (!std::isfinite(p.constants_upper - p.constants_lower))
    return ParameterFault{"constants_upper", format_number(p.constants_upper),
                          "must be a finite way above constants_lower"};
  return std::nullopt;
}

}  // namespace

std::optional<ParameterFault> find_fault(const GpParameters& p) {
  if (auto fault = count_fault(p)) return fault;
  if (auto fault = rate_fault(p)) return fault;
  if (auto fault = depth_fault(p)) return fault;
  if (auto fault = nodes_fault(p)) return fault;
  if (p.tournament_size > p.population_size)
    return ParameterFault{"tournament_size", format_number(p.tournament_size), "must not exceed population_size"};
  if (auto fault = function_fault(p.functions)) return fault;
  if (auto fault = weights_fault(p)) return fault;
  if (auto fault = shared_fault(p)) return fault;
  if (p.restart_after < 0)
    return ParameterFault{"restart_after", format_number(p.restart_after), "must not be negative"};
  return constants_fault(p);
}

}  // namespace demecal::inline fitness
