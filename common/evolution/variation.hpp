// How offspring differ from their parents: subtree crossover, subtree mutation, shrink mutation (thesis 3.3.4).
#pragma once

#include "evolution/parameters.hpp"
#include "evolution/tree_generation.hpp"
#include "evolution/tree_point.hpp"
#include "expression/node_store.hpp"

namespace demecal {

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

}  // namespace demecal
