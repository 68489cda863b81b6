// How offspring differ from their parents: subtree crossover, subtree mutation, shrink mutation (thesis 3.3.4).
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "evolution/tree_generation.hpp"
#include "expression/node_store.hpp"
#include "expression/tree.hpp"
#include "fitness/parameters.hpp"
#include "random/random_stream.hpp"

namespace demecal::inline evolution {

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

/// Varies formulas of a store within the limits: an offspring is valid where min_tree_depth <= depth <= max_tree_depth
/// and it has no more than max_tree_nodes. Points are drawn up to invalid_attempts times until what they give is valid.
/// Only nodes on the way from the root to a point are made anew. Keeps its scratch memory between calls.
class Variation {
 public:
  Variation(const GpParameters& parameters, int variables);

  /// Swaps a subtree of `mother` with one of `father`. Each point is a terminal with terminal_crossover_rate, otherwise
  /// a function; all of the kind are equally likely. False, and the offspring unchanged, where no attempt gave two
  /// valid offspring.
  bool cross(RandomStream& random, NodeStore& store, NodeId mother, NodeId father, NodeId& daughter, NodeId& son) const;

  /// Replaces a subtree by a grown one. With shrink_mutation_rate the subtree is rooted at a function and gives way to
  /// one of strictly lower depth; otherwise the point is a terminal with terminal_mutation_rate and the new subtree as
  /// deep as max_tree_depth allows there. False, and `formula` unchanged, where no attempt was valid.
  bool mutate(RandomStream& random, NodeStore& store, NodeId& formula);

 private:
  bool is_valid(const NodeStore& store, NodeId formula, const TreePoint& point, int nodes, int depth) const;

  GpParameters parameters_;
  NodeSet nodes_;
  Tree grown_;
};

}  // namespace demecal::inline evolution
