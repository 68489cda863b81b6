// How offspring differ from their parents: subtree crossover, subtree mutation, shrink mutation (thesis 3.3.4).
#pragma once

#include "evolution/parameters.hpp"
#include "evolution/tree_generation.hpp"
#include "evolution/tree_shape.hpp"

namespace demecal {

/// Varies trees within the depth limits: an offspring is valid where min_tree_depth <= depth <= max_tree_depth. Points
/// are drawn up to invalid_attempts times until what they give is valid. Keeps its scratch memory between calls.
class Variation {
 public:
  Variation(const GpParameters& parameters, int variables);

  /// Swaps a subtree of `mother` with one of `father`. Each point is a terminal with terminal_crossover_rate, otherwise
  /// a function; all of the kind are equally likely. False, and the offspring unchanged, where no attempt gave two
  /// valid offspring. The offspring must not be the parents.
  bool cross(RandomStream& random, const Tree& mother, const Tree& father, Tree& daughter, Tree& son);

  /// Replaces a subtree by a grown one. With shrink_mutation_rate the subtree is rooted at a function and gives way to
  /// one of strictly lower depth; otherwise the point is a terminal with terminal_mutation_rate and the new subtree as
  /// deep as max_tree_depth allows there. False, and `tree` unchanged, where no attempt was valid.
  bool mutate(RandomStream& random, Tree& tree);

 private:
  bool is_valid_depth(int depth) const;
  std::size_t mutation_point(RandomStream& random, bool shrink) const;

  GpParameters parameters_;
  NodeSet nodes_;
  TreeShape mother_shape_, father_shape_;
  Tree grown_, mutated_;
};

}  // namespace demecal
