// The fitness of whole populations whose formulas share their subtrees.
#pragma once

#include <span>
#include <vector>

#include "evolution/fitness.hpp"
#include "expression/shared_evaluator.hpp"

namespace demecal {

/// Gives the bits of Fitness; remembers the fitness of every node it was asked about.
class SharedFitness {
 public:
  /// The columns kept between generations then stay near the processor.
  static constexpr std::size_t kColumnBudgetBytes = std::size_t{2} << 20;

  explicit SharedFitness(const TrainingTable& table, std::size_t budget_bytes = kColumnBudgetBytes);

  /// Finds out what is to be computed for the formulas `roots` of `store`.
  void bind(const NodeStore& store, std::span<const NodeId> roots);
  /// Computes it.
  void run();
  /// What the last run() or an earlier one found.
  double of(NodeId root) const { return known_[root]; }

  /// Drops what is known of nodes that the store dropped.
  void forget(std::span<const NodeId> dropped);

  const SharedEvaluator& evaluator() const { return evaluator_; }

 private:
  ErrorSum errors_;
  SharedEvaluator evaluator_;
  std::vector<double> known_;  ///< by node; not a number where unknown
  std::vector<NodeId> asked_;  ///< formulas of unknown fitness, each once
  std::vector<ErrorSum::Lanes> sums_;
};

}  // namespace demecal
