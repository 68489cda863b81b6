#include "evolution/tree_shape.hpp"

#include <algorithm>

namespace demecal {

void TreeShape::measure(std::span<const Node> tree) {
  nodes_.resize(tree.size() + 1);
  measure_subtrees(tree);
  measure_levels(tree);
}

void TreeShape::measure_subtrees(std::span<const Node> tree) {
  for (std::size_t i = tree.size(); i-- > 0;) {
    std::uint32_t end = static_cast<std::uint32_t>(i) + 1;
    std::int32_t depth = 0;
    for (int argument = arity(tree[i].primitive); argument > 0; --argument) {
      depth = std::max(depth, nodes_[end].depth + 1);
      end = nodes_[end].end;
    }
    nodes_[i].end = end;
    nodes_[i].depth = depth;
  }
}

void TreeShape::measure_levels(std::span<const Node> tree) {
  terminals_.clear();
  functions_.clear();
  nodes_.front().level = 0;
  std::int32_t deepest = 0;
  for (std::size_t i = 0; i < tree.size(); ++i) {
    Place& place = nodes_[i];
    place.deepest_before = deepest;
    deepest = std::max(deepest, place.level);
    const int arguments = arity(tree[i].primitive);
    (arguments == 0 ? terminals_ : functions_).push_back(static_cast<std::uint32_t>(i));
    if (arguments > 0) nodes_[i + 1].level = place.level + 1;
    if (arguments > 1) nodes_[nodes_[i + 1].end].level = place.level + 1;
  }
  nodes_.back().deepest_from = 0;
  for (std::size_t i = tree.size(); i-- > 0;)
    nodes_[i].deepest_from = std::max(nodes_[i + 1].deepest_from, nodes_[i].level);
}

int TreeShape::depth_with(std::size_t node, int replacement) const {
  const Place& place = nodes_[node];
  return std::max({place.deepest_before, nodes_[place.end].deepest_from, place.level + replacement});
}

}  // namespace demecal
