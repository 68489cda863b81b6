#include "evolution/tree_generation.hpp"

#include <algorithm>
#include <bit>
#include <numeric>
#include <span>

namespace demecal::inline evolution {
namespace {

std::uint64_t tree_hash(const Tree& tree) {
  std::uint64_t hash = tree.size();
  for (const Node& node : tree) {
    const auto label = static_cast<std::uint64_t>(node.primitive) << 8 | node.variable;
    hash = (hash ^ std::bit_cast<std::uint64_t>(node.value) ^ label << 40) * 0x9E3779B97F4A7C15ULL;
    hash ^= hash >> 29;
  }
  return hash;
}

}  // namespace

void TreeIndex::clear(std::size_t most) {
  slots_.assign(std::bit_ceil(2 * most + 2), Slot{});
}

std::size_t TreeIndex::enter(const Tree& tree, std::size_t number) {
  const std::uint64_t hash = tree_hash(tree);
  const std::size_t mask = slots_.size() - 1;
  std::size_t place = hash & mask;
  for (; slots_[place].tree != nullptr; place = (place + 1) & mask)
    if (slots_[place].hash == hash && *slots_[place].tree == tree) return slots_[place].number;
  slots_[place] = {hash, &tree, number};
  return number;
}

namespace {

// With deep minima and few functions GROW hardly ever reaches the minimum; FULL then does.
constexpr int kGrowAttempts = 1000;

void append_function(Primitive function, Tree& tree) {
  tree.push_back({function, 0, 0.0});
}

std::size_t draw_weighted(RandomStream& random, std::span<const double> weights) {
  double left = random.real(0.0, std::accumulate(weights.begin(), weights.end(), 0.0));
  std::size_t i = 0;
  while (i + 1 < weights.size() && left >= weights[i]) left -= weights[i++];
  return i;
}

CallableFunction make_callable(const SharedFunction& function) {
  CallableFunction made{function, 0, std::vector<int>(static_cast<std::size_t>(arity(function)), 0)};
  std::vector<int> levels{0};
  for (const Node& node : function.body) {
    const int level = levels.back();
    levels.pop_back();
    levels.insert(levels.end(), static_cast<std::size_t>(arity(node.primitive)), level + 1);
    made.depth = std::max(made.depth, level);
    if (node.primitive == Primitive::variable)
      made.deepest[node.variable] = std::max(made.deepest[node.variable], level);
  }
  return made;
}

std::vector<double> draw_weights(const GpParameters& parameters) {
  std::vector<double> weights = parameters.function_weights;
  if (parameters.shared_functions.empty()) return weights;
  if (weights.empty() && parameters.shared_function_weight == 1.0) return weights;
  weights.resize(parameters.functions.size(), 1.0);
  weights.resize(weights.size() + parameters.shared_functions.size(), parameters.shared_function_weight);
  return weights;
}

/// A function's place among functions and calls; `drawn` is that where all are alike. One that is too deep for what is
/// left gives way to a function.
std::size_t draw_function(RandomStream& random, const NodeSet& nodes, std::size_t drawn, int depth) {
  const std::size_t functions = nodes.functions.size();
  const std::size_t chosen = nodes.weights.empty() ? drawn : draw_weighted(random, nodes.weights);
  if (chosen < functions || nodes.calls[chosen - functions].depth <= depth) return chosen;
  return nodes.weights.empty() ? random.index(functions)
                               : draw_weighted(random, std::span(nodes.weights).first(functions));
}

/// Appends what a call comes to, its arguments made by `append_argument(depth, tree)`. Returns its depth.
template <class AppendArgument>
int append_call(RandomStream& random, const NodeSet& nodes, const CallableFunction& call, int depth_left,
                const AppendArgument& append_argument, Tree& tree) {
  std::vector<Tree> places(call.deepest.size());
  for (std::size_t i = 0; i < places.size(); ++i) {
    if (i < static_cast<std::size_t>(call.function.coefficients))
      places[i] = constant_tree(random.real(nodes.constants_lower, nodes.constants_upper));
    else
      append_argument(depth_left - call.deepest[i], places[i]);
  }
  const Tree whole = expanded(call.function, places);
  tree.insert(tree.end(), whole.begin(), whole.end());
  return depth(whole);
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
  NodeSet nodes{parameters.functions,     variables, parameters.constants_lower, parameters.constants_upper,
                draw_weights(parameters), {}};
  for (const SharedFunction& function : parameters.shared_functions) nodes.calls.push_back(make_callable(function));
  return nodes;
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
  const std::size_t kinds = terminals + nodes.functions.size() + nodes.calls.size();
  const std::size_t drawn = depth == 0 ? 0 : random.index(kinds);
  if (drawn < terminals) {
    append_terminal(random, nodes, tree);
    return 0;
  }
  const std::size_t chosen = draw_function(random, nodes, drawn - terminals, depth);
  if (chosen >= nodes.functions.size()) {
    const auto grow = [&](int left, Tree& argument) { append_grown(random, nodes, left, argument); };
    return append_call(random, nodes, nodes.calls[chosen - nodes.functions.size()], depth, grow, tree);
  }
  const Primitive function = nodes.functions[chosen];
  append_function(function, tree);
  int deepest = 0;
  for (int argument = 0; argument < arity(function); ++argument)
    deepest = std::max(deepest, append_grown(random, nodes, depth - 1, tree));
  return deepest + 1;
}

void append_full(RandomStream& random, const NodeSet& nodes, int depth, Tree& tree) {
  if (depth == 0) return append_terminal(random, nodes, tree);
  const std::size_t drawn = nodes.weights.empty() ? random.index(nodes.functions.size() + nodes.calls.size()) : 0;
  const std::size_t chosen = draw_function(random, nodes, drawn, depth);
  if (chosen >= nodes.functions.size()) {
    const auto fill = [&](int left, Tree& argument) { append_full(random, nodes, left, argument); };
    append_call(random, nodes, nodes.calls[chosen - nodes.functions.size()], depth, fill, tree);
    return;
  }
  const Primitive function = nodes.functions[chosen];
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

}  // namespace demecal::inline evolution
