#include "evolution/tree_generation.hpp"

#include <algorithm>
#include <numeric>

#include "evolution/tree_index.hpp"

namespace demecal {
namespace {

// With deep minima and few functions GROW hardly ever reaches the minimum; FULL then does.
constexpr int kGrowAttempts = 1000;

void append_function(Primitive function, Tree& tree) {
  tree.push_back({function, 0, 0.0});
}

Primitive weighed_function(RandomStream& random, const NodeSet& nodes) {
  const std::vector<double>& weights = nodes.weights;
  double left = random.real(0.0, std::accumulate(weights.begin(), weights.end(), 0.0));
  std::size_t i = 0;
  while (i + 1 < weights.size() && left >= weights[i]) left -= weights[i++];
  return nodes.functions[i];
}

void grow_at_least(RandomStream& random, const NodeSet& nodes, int min_depth, int max_depth, Tree& tree) {
  for (int attempt = 0; attempt < kGrowAttempts; ++attempt) {
    tree.clear();
    if (append_grown(random, nodes, max_depth, tree) >= min_depth) return;
  }
  tree.clear();
  append_full(random, nodes, max_depth, tree);
}

struct Ramp {
  int first, last;
  int depth(std::size_t pair) const {
    return first + static_cast<int>(pair % static_cast<std::size_t>(last - first + 1));
  }
};

}  // namespace

NodeSet node_set(const GpParameters& parameters, int variables) {
  return {parameters.functions, variables, parameters.constants_lower, parameters.constants_upper,
          parameters.function_weights};
}

void append_terminal(RandomStream& random, const NodeSet& nodes, Tree& tree) {
  const auto drawn = static_cast<int>(random.index(static_cast<std::size_t>(nodes.variables) + 1));
  if (drawn < nodes.variables)
    tree.push_back({Primitive::variable, static_cast<std::uint8_t>(drawn), 0.0});
  else
    tree.push_back({Primitive::constant, 0, random.real(nodes.constants_lower, nodes.constants_upper)});
}

int append_grown(RandomStream& random, const NodeSet& nodes, int depth, Tree& tree) {
  const std::size_t terminals = static_cast<std::size_t>(nodes.variables) + 1;
  const std::size_t drawn = depth == 0 ? 0 : random.index(terminals + nodes.functions.size());
  if (drawn < terminals) {
    append_terminal(random, nodes, tree);
    return 0;
  }
  const Primitive function =
      nodes.weights.empty() ? nodes.functions[drawn - terminals] : weighed_function(random, nodes);
  append_function(function, tree);
  int deepest = 0;
  for (int argument = 0; argument < arity(function); ++argument)
    deepest = std::max(deepest, append_grown(random, nodes, depth - 1, tree));
  return deepest + 1;
}

void append_full(RandomStream& random, const NodeSet& nodes, int depth, Tree& tree) {
  if (depth == 0) return append_terminal(random, nodes, tree);
  const Primitive function =
      nodes.weights.empty() ? nodes.functions[random.index(nodes.functions.size())] : weighed_function(random, nodes);
  append_function(function, tree);
  for (int argument = 0; argument < arity(function); ++argument) append_full(random, nodes, depth - 1, tree);
}

std::vector<Tree> ramped_half_and_half(RandomStream& random, const GpParameters& parameters, int variables) {
  const NodeSet nodes = node_set(parameters, variables);
  const Ramp ramp{parameters.initial_max_tree_depth1, parameters.initial_max_tree_depth2};
  std::vector<Tree> trees(static_cast<std::size_t>(parameters.population_size));
  trees[0] = neutral_tree();
  TreeIndex index(trees.size());
  index.enter(trees[0], 0);
  for (std::size_t i = 1; i < trees.size(); ++i) {
    Tree& tree = trees[i];
    const int depth = ramp.depth((i - 1) / 2);
    bool is_new = false;
    for (int attempt = 0; !is_new && (attempt < parameters.invalid_attempts || tree == trees[0]); ++attempt) {
      tree.clear();
      if (i % 2 == 1)
        append_full(random, nodes, depth, tree);
      else
        grow_at_least(random, nodes, parameters.min_tree_depth, depth, tree);
      is_new = index.enter(tree, i) == i;
    }
  }
  return trees;
}

}  // namespace demecal
