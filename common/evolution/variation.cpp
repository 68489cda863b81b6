#include "evolution/variation.hpp"

#include <algorithm>
#include <cstddef>

#include "errors/check.hpp"

namespace demecal::inline evolution {

// A missing second argument counts as one of depth 0, which is no deeper than this point lies.
inline void TreePoint::descend(const SharedNode& node, bool to_right) {
  way_[static_cast<std::size_t>(level_)] = {node_, to_right};
  ++level_;
  depth_beside_ = std::max(depth_beside_, level_ + (to_right ? node.of_left.depth : node.depth_of_right));
  node_ = to_right ? node.right : node.left;
}

TreePoint TreePoint::terminal(const NodeStore& store, NodeId root, std::uint32_t number) {
  DEMECAL_CHECK(store[root].whole.depth <= kDeepestTree && number < store[root].whole.terminals, "number=" << number);
  TreePoint point(root);
  while (store[point.node_].left != 0) {
    const SharedNode& node = store[point.node_];
    const std::uint32_t on_the_left = node.of_left.terminals;
    const bool to_right = number >= on_the_left;
    number -= to_right ? on_the_left : 0;
    point.descend(node, to_right);
  }
  return point;
}

TreePoint TreePoint::function(const NodeStore& store, NodeId root, std::uint32_t number) {
  DEMECAL_CHECK(store[root].whole.depth <= kDeepestTree && number < store[root].whole.functions(), "number=" << number);
  TreePoint point(root);
  while (number > 0) {
    const SharedNode& node = store[point.node_];
    --number;
    const std::uint32_t on_the_left = node.of_left.functions();
    const bool to_right = number >= on_the_left;
    number -= to_right ? on_the_left : 0;
    point.descend(node, to_right);
  }
  return point;
}

int TreePoint::depth_with(int replacement) const {
  return std::max(depth_beside_, level_ + replacement);
}

NodeId TreePoint::replaced(NodeStore& store, NodeId replacement) const {
  NodeId built = replacement;
  for (int level = level_; level-- > 0;) {
    const Arc& arc = way_[static_cast<std::size_t>(level)];
    const SharedNode above = store[arc.from];
    built = arc.to_right ? store.function(above.primitive, above.left, built)
                         : store.function(above.primitive, built, above.right);
  }
  return built;
}

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

}  // namespace demecal::inline evolution
