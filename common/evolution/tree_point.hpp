// A place in a formula and the way to it from the root: where crossover and mutation cut.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "evolution/parameters.hpp"
#include "expression/node_store.hpp"

namespace demecal {

/// A node of a formula as a tree; finding one takes as many steps as it lies deep.
class TreePoint {
 public:
  /// The terminal, or the function, before which `number` others stand in prefix order. The formula must have it, and
  /// be no deeper than kDeepestTree.
  static TreePoint terminal(const NodeStore& store, NodeId root, std::uint32_t number);
  static TreePoint function(const NodeStore& store, NodeId root, std::uint32_t number);

  NodeId node() const { return node_; }
  int level() const { return level_; }  ///< arcs from the root
  /// Depth of the whole formula if the subtree here gave way to one of depth `replacement`.
  int depth_with(int replacement) const;

  /// The formula with the subtree here replaced.
  NodeId replaced(NodeStore& store, NodeId replacement) const;

 private:
  explicit TreePoint(NodeId root) : node_(root) {}
  void descend(const SharedNode& node, bool to_right);

  struct Arc {
    NodeId from;
    bool to_right;
  };
  NodeId node_;
  int level_ = 0;
  int depth_beside_ = 0;               ///< of the formula without the subtree
  std::array<Arc, kDeepestTree> way_;  ///< from the root; level_ arcs
};

}  // namespace demecal
