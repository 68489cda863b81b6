// How well a formula fits: the weighted sum of errors over a joint's calibration rows.
#pragma once

#include <limits>
#include <vector>

#include "evolution/error_sum.hpp"

namespace demecal {

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

}  // namespace demecal
