#include "evolution/tree_point.hpp"

#include <algorithm>

#include "errors/check.hpp"

namespace demecal {

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

}  // namespace demecal
