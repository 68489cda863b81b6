// How well formulas fit: the weighted sum of errors over a joint's calibration rows, and whether they keep to its
// limit.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "expression/bound.hpp"
#include "expression/evaluate.hpp"
#include "expression/node_store.hpp"
#include "expression/tree.hpp"
#include "primitives/columns.hpp"

namespace demecal::inline fitness {

/// What a row's error counts: its size, as in direct learning (thesis eq. 4.12), or its square, as in the performance
/// index of the whole model (eq. 4.6).
enum class Loss : std::uint8_t { absolute, squared };

/// sum_k weight_k |target_k - value_k|, or of the squares. Rows are added by turns into kLanes sums, and those
/// pairwise.
class ErrorSum {
 public:
  using Lanes = std::array<double, kLanes>;

  /// Keeps copies of the columns, which are of equal length.
  ErrorSum(const std::vector<double>& target, const std::vector<double>& weight, Loss loss = Loss::absolute);

  /// Adds the rows from `begin` on, `rows` of them, both multiples of kLanes. Rows beyond the last must repeat its
  /// value.
  void add(Lanes& sums, std::size_t begin, const double* values, std::size_t rows) const;
  /// The whole sum; infinite where any row's value is not finite, be its weight zero.
  static double total(const Lanes& sums);

 private:
  AlignedColumn target_, weight_;  ///< padded to whole vectors, without weight
  Loss loss_;
};

/// What one joint's islands learn from. Row k: target[k] is theta_C - theta_N in units of `scale`, which all islands
/// share so that the ephemeral constants are of the target's size.
struct TrainingTable {
  std::vector<std::vector<double>> variables;  ///< one column per variable; direct learning has theta alone, rad
  std::vector<double> target;
  std::vector<double> weight;  ///< 0 to 1: poses near a singularity count less
  Loss loss = Loss::absolute;  ///< what fitness sums
  std::vector<Tree> seeds{};   ///< formulas that every first population holds, where they fit its limits
  /// What the size of a formula may be at most between its variable's least and greatest row; where that is limited
  /// there is one variable.
  double limit = std::numeric_limits<double>::infinity();

  bool operator==(const TrainingTable&) const = default;
};

/// A programmer's error where the columns are not of equal length, there is no variable, or there are several and a
/// limit.
void check_columns(const TrainingTable& table);

/// The fitness of one formula at a time.
class Fitness {
 public:
  explicit Fitness(const TrainingTable& table);
  /// sum_k weight_k |target_k - tree(row k)|, or of the squares, as the table says; infinite where any row is not
  /// finite.
  double operator()(const Tree& tree);

 private:
  ErrorSum errors_;
  ColumnEvaluator evaluate_;
};

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

/// Judges formulas of one store by interval arithmetic, and remembers: a pole that cannot be excluded is beyond every
/// limit. Without a limit all are safe.
class SafeFormulas {
 public:
  explicit SafeFormulas(const TrainingTable& table);

  bool is_on() const { return is_on_; }
  bool operator()(const NodeStore& store, NodeId root);
  /// Drops what is known of nodes that the store dropped.
  void forget(std::span<const NodeId> dropped);

 private:
  enum class Verdict : std::uint8_t { unknown, safe, unsafe };

  bool is_on_;
  double limit_;
  Interval range_;
  std::vector<Verdict> known_;  ///< by node
  Tree tree_;
};

}  // namespace demecal::inline fitness
