// One generation from the one before: elitism, selection, variation, evaluation and learning (thesis 3.2.2 to 3.3.4).
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "evolution/variation.hpp"
#include "expression/node_store.hpp"
#include "expression/tree.hpp"
#include "fitness/constant_fit.hpp"
#include "fitness/fitness.hpp"
#include "fitness/parameters.hpp"
#include "random/random_stream.hpp"

namespace demecal::inline evolution {

/// fitness[i] is that of models[i]: of roots[i] itself or, where fitted constants are not inherited, of what roots[i]
/// was fitted to; models[i] is 0 where that is no longer known.
struct SharedPopulation {
  std::vector<NodeId> roots;
  std::vector<double> fitness;
  std::vector<NodeId> models;
};

/// Fits the individuals of one store's generations. Which are fitted, and what comes out, is a function of table,
/// parameters and the generation at hand, not of what was fitted before.
class ConstantLearning {
 public:
  ConstantLearning(const TrainingTable& table, const GpParameters& parameters);

  bool is_on() const { return is_on_; }
  /// Individual i of the population fitted, whatever the share.
  void learn(NodeStore& store, SharedPopulation& population, std::size_t i);
  /// Offspring that equal a parent take over what it knew. Of the others, the fittest constant_share of a population
  /// are fitted; of equally fit ones those that come first.
  void learn(NodeStore& store, const SharedPopulation& parents, SharedPopulation& offspring);

  /// Forgets all fits: numbers of the store have new meanings.
  void forget();
  std::uint64_t fits() const { return fits_; }  ///< made so far, those remembered not counted

 private:
  struct Known {
    FittedFormula fitted;
    std::uint64_t parent_of = 0;  ///< the last generation in which this was a parent, and which one
    std::uint32_t parent = 0;
    bool is_fitted = false;
  };
  void choose(const SharedPopulation& offspring);

  ConstantFit fit_;
  bool is_on_, is_inherited_;
  double share_;
  std::vector<Known> known_;  ///< by node
  std::vector<std::size_t> chosen_;
  std::uint64_t generation_ = 0;
  std::uint64_t fits_ = 0;
};

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
  void replace(NodeId root, SharedPopulation& population, std::size_t i);
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

}  // namespace demecal::inline evolution
