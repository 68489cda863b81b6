// Where a tree's subtrees begin, end and hang: what crossover and mutation need to choose points without trying trees.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "expression/tree.hpp"

namespace demecal {

/// The shape of one tree at a time; measuring another reuses the memory.
class TreeShape {
 public:
  /// `tree` must be valid.
  void measure(std::span<const Node> tree);

  std::size_t end(std::size_t node) const { return nodes_[node].end; }        ///< one past the subtree's last node
  int level(std::size_t node) const { return nodes_[node].level; }            ///< arcs from the root
  int subtree_depth(std::size_t node) const { return nodes_[node].depth; }    ///< arcs to the subtree's deepest leaf
  const std::vector<std::uint32_t>& terminals() const { return terminals_; }  ///< their places, ascending
  const std::vector<std::uint32_t>& functions() const { return functions_; }

  /// Depth of the whole tree if the subtree at `node` gave way to one of depth `replacement`.
  int depth_with(std::size_t node, int replacement) const;

 private:
  void measure_subtrees(std::span<const Node> tree);
  void measure_levels(std::span<const Node> tree);

  struct Place {
    std::uint32_t end = 0;
    std::int32_t level = 0;
    std::int32_t depth = 0;
    std::int32_t deepest_before = 0;  ///< greatest level of the nodes before this one
    std::int32_t deepest_from = 0;    ///< greatest level of this node and those after it
  };
  std::vector<Place> nodes_;  ///< one more than the tree has, for the end
  std::vector<std::uint32_t> terminals_, functions_;
};

}  // namespace demecal
