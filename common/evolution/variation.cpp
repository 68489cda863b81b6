#include "evolution/variation.hpp"

namespace demecal {
namespace {

TreePoint draw_point(RandomStream& random, const NodeStore& store, NodeId formula, double terminal_rate) {
  const TreeExtent& root = store[formula].whole;
  const bool terminal = random.chance(terminal_rate) || root.functions() == 0;
  const auto number = static_cast<std::uint32_t>(random.index(terminal ? root.terminals : root.functions()));
  return terminal ? TreePoint::terminal(store, formula, number) : TreePoint::function(store, formula, number);
}

}  // namespace

Variation::Variation(const GpParameters& parameters, int variables)
    : parameters_(parameters), nodes_(node_set(parameters, variables)) {}

// Whether the formula is valid once a subtree of `nodes` and `depth` stands at the point.
bool Variation::is_valid(const NodeStore& store, NodeId formula, const TreePoint& point, int nodes, int depth) const {
  const int whole = point.depth_with(depth);
  if (whole < parameters_.min_tree_depth || whole > parameters_.max_tree_depth) return false;
  const int others = store[formula].whole.nodes - store[point.node()].whole.nodes;
  return parameters_.max_tree_nodes == 0 || others + nodes <= parameters_.max_tree_nodes;
}

bool Variation::cross(RandomStream& random, NodeStore& store, NodeId mother, NodeId father, NodeId& daughter,
                      NodeId& son) const {
  for (int attempt = 0; attempt < parameters_.invalid_attempts; ++attempt) {
    const TreePoint hers = draw_point(random, store, mother, parameters_.terminal_crossover_rate);
    const TreePoint his = draw_point(random, store, father, parameters_.terminal_crossover_rate);
    const TreeExtent &her_part = store[hers.node()].whole, &his_part = store[his.node()].whole;
    if (!is_valid(store, mother, hers, his_part.nodes, his_part.depth)) continue;
    if (!is_valid(store, father, his, her_part.nodes, her_part.depth)) continue;
    if (hers.node() == his.node()) continue;
    daughter = hers.replaced(store, his.node());
    son = his.replaced(store, hers.node());
    return true;
  }
  return false;
}

bool Variation::mutate(RandomStream& random, NodeStore& store, NodeId& formula) {
  for (int attempt = 0; attempt < parameters_.invalid_attempts; ++attempt) {
    const bool shrink = random.chance(parameters_.shrink_mutation_rate) && store[formula].whole.functions() > 0;
    const TreePoint point = draw_point(random, store, formula, shrink ? 0.0 : parameters_.terminal_mutation_rate);
    const int deepest = shrink ? store[point.node()].whole.depth - 1 : parameters_.max_tree_depth - point.level();
    grown_.clear();
    const int grown_depth = append_grown(random, nodes_, deepest, grown_);
    if (!is_valid(store, formula, point, static_cast<int>(grown_.size()), grown_depth)) continue;
    const NodeId grown = store.enter(grown_);
    if (grown == point.node()) continue;
    formula = point.replaced(store, grown);
    return true;
  }
  return false;
}

}  // namespace demecal
