// Which of the formulas that islands found is reported: the one that describes measured and unseen rows most briefly.
#pragma once

#include <cstddef>
#include <utility>
#include <vector>

#include "evolution/population.hpp"
#include "expression/evaluate.hpp"
#include "expression/simplify.hpp"
#include "expression/tree.hpp"
#include "fitness/constant_fit.hpp"
#include "fitness/fitness.hpp"
#include "fitness/parameters.hpp"

namespace demecal::inline evolution {

/// Nats that it takes to write down the errors, normal and of unknown size, of a formula with mean square `square` over
/// `rows` rows, and the formula: one for every node and log(rows) / 2 more for every constant (after Rissanen 1978).
double description_length_nats(const Tree& tree, double square, double rows);

/// Rewrites formulas of one training table.
class FormulaRefiner {
 public:
  FormulaRefiner(const TrainingTable& training, const GpParameters& parameters)
      : columns_(training.variables), fit_(training, parameters) {}

  /// With terms collected and without what changes no value on the training rows.
  Tree simplified(const Tree& tree) const { return simplified_over(tree, columns_); }
  /// That with its constants fitted to the training rows by least squares.
  Tree fitted(const Tree& simple);

 private:
  std::vector<std::vector<double>> columns_;
  ConstantFit fit_;
};

/// Keeps the best formula of each length by its weighted mean squared error over the rows that evolution learnt from
/// and as many as it never saw: for the ones a formula may be fitted too well, for the others only chosen too well.
class ModelArchive {
 public:
  ModelArchive(const TrainingTable& training, const TrainingTable& validation, const GpParameters& parameters);

  /// Offers the front of an island of the training table: each member simplified and, where it comes near the best,
  /// with its constants fitted to the training rows by least squares. Members of the front offered last are passed
  /// over.
  void offer(const Population& front);

  /// The formula of least description_length_nats(), with its mean square as fitness; null where no formula was offered
  /// that is finite on all rows.
  const Individual* chosen() const;

 private:
  double mean_square(const Tree& tree);
  double offer(const Tree& tree);

  FormulaRefiner brief_;
  TrainingTable rows_;
  double weights_ = 0.0;
  ColumnEvaluator evaluate_;
  ParetoFront front_;
  std::vector<std::pair<std::size_t, double>> last_;  ///< length and fitness of the members offered last
};

}  // namespace demecal::inline evolution
