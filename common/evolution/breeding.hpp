// One generation from the one before: elitism, selection, variation and evaluation (thesis 3.2.2 to 3.3.4).
#pragma once

#include <cstdint>
#include <vector>

#include "evolution/constant_learning.hpp"
#include "evolution/parameters.hpp"
#include "evolution/safe_formulas.hpp"
#include "evolution/shared_fitness.hpp"
#include "evolution/shared_population.hpp"
#include "evolution/variation.hpp"
#include "random/random_stream.hpp"

namespace demecal {

/// Breeds generations, keeping the formulas, what is known of them and its memory. Elitism 1: the fittest parent comes
/// first, unchanged. All others are made in pairs by parents from two tournaments. CROSSOVER_RATE and MUTATION_RATE are
/// independent chances: a pair is crossed with the one, and then each of the two, crossed or copied, is mutated with
/// the other; what neither touched is reproduction. Where no_duplicates is on, an offspring that equals an earlier one
/// is mutated until it does not, up to invalid_attempts times; fitted constants may make equals of different ones
/// after.
class Breeder {
 public:
  /// `budget_bytes` bounds the memory for columns that are kept; results do not depend on it.
  Breeder(const GpParameters& parameters, const TrainingTable& table,
          std::size_t budget_bytes = SharedFitness::kColumnBudgetBytes);

  /// Enters formulas in the store, evaluates them and has them learn.
  SharedPopulation enter(const std::vector<Tree>& trees);
  NodeId enter(const Tree& tree) { return store_.enter(tree); }
  double fitness(NodeId root);
  /// Has a formula of the store take place i, and learn what constants it is fitted with, whatever the share.
  void settle(NodeId root, SharedPopulation& population, std::size_t i);
  /// Whether a formula of the store surely keeps to the table's limit.
  bool limits() const { return is_safe_.is_on(); }  ///< whether there is one
  bool is_safe(NodeId root) { return is_safe_(store_, root); }
  const NodeStore& store() const { return store_; }
  const SharedFitness& known() const { return fitness_; }
  const ConstantLearning& learning() const { return learning_; }

  /// Replaces `population` by the next generation of the same size. Returns how many of its trees equal no parent and
  /// no earlier offspring: what a breeder without a memory has to evaluate.
  std::uint64_t breed(RandomStream& random, SharedPopulation& population);

  /// The parts of breed(), in turn. First the offspring are made;
  void vary(RandomStream& random, const SharedPopulation& parents);
  /// then what their fitness takes is found out;
  void bind() { fitness_.bind(store_, offspring_.roots); }
  /// then it is computed;
  std::uint64_t evaluate(const SharedPopulation& parents);
  /// then the offspring learn (see ConstantLearning) and take their parents' place.
  void learn(SharedPopulation& population);

 private:
  void collect(const SharedPopulation& parents);
  void make_pair(RandomStream& random, const SharedPopulation& parents, NodeId& daughter, NodeId& son);
  void make_different(RandomStream& random, NodeId& formula);
  std::uint64_t count_new(const SharedPopulation& parents);

  GpParameters parameters_;
  NodeStore store_;
  SharedFitness fitness_;
  ConstantLearning learning_;
  SafeFormulas is_safe_;
  Variation variation_;
  SharedPopulation offspring_;
  std::vector<NodeId> live_;
  std::vector<std::uint64_t> seen_;  ///< by node: the last generation that had it as an individual
  std::vector<std::uint64_t> bred_;  ///< by node: the last variation that made it an offspring
  std::uint64_t variation_count_ = 0;
  std::uint64_t generation_ = 0;
  std::size_t size_after_collection_ = 0;
};

}  // namespace demecal
