// One generation from the one before: elitism, selection, variation and evaluation (thesis 3.2.2 to 3.3.4).
#pragma once

#include <cstdint>

#include "evolution/fitness.hpp"
#include "evolution/individual.hpp"
#include "evolution/parameters.hpp"
#include "evolution/tree_index.hpp"
#include "evolution/variation.hpp"
#include "random/random_stream.hpp"

namespace demecal {

/// Breeds generations, keeping their memory. Elitism 1: the fittest parent comes first, unchanged. All others are made
/// in pairs by parents from two tournaments. CROSSOVER_RATE and MUTATION_RATE are independent chances: a pair is
/// crossed with the one, and then each of the two, crossed or copied, is mutated with the other; what neither touched
/// is reproduction.
class Breeder {
 public:
  Breeder(const GpParameters& parameters, int variables);

  /// Replaces `population`, whose fitness values must be those of its trees, by the next generation of the same size.
  /// Returns how many trees were evaluated: one that equals a parent or an earlier offspring takes over its fitness.
  std::uint64_t breed(RandomStream& random, Population& population, Fitness& fitness);

 private:
  void make_offspring(RandomStream& random, const Population& parents);
  void make_pair(RandomStream& random, const Population& parents, Tree& daughter, Tree& son);
  std::uint64_t evaluate(const Population& parents, Fitness& fitness);

  GpParameters parameters_;
  Variation variation_;
  Population offspring_;
  Tree surplus_;
  TreeIndex index_;
};

}  // namespace demecal
