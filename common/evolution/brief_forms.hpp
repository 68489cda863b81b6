// What evolved formulas come to when they are written down briefly and their constants are fitted.
#pragma once

#include <vector>

#include "evolution/constant_fit.hpp"
#include "expression/simplify.hpp"

namespace demecal {

/// Nats that it takes to write down the errors, normal and of unknown size, of a formula with mean square `square` over
/// `rows` rows, and the formula: one for every node and log(rows) / 2 more for every constant (after Rissanen 1978).
double message_nats(const Tree& tree, double square, double rows);

/// Rewrites formulas of one training table.
class BriefForms {
 public:
  BriefForms(const TrainingTable& training, const GpParameters& parameters)
      : columns_(training.variables), fit_(training, parameters) {}

  /// With terms collected and without what changes no value on the training rows.
  Tree simplified(const Tree& tree) const { return simplified_over(tree, columns_); }
  /// That with its constants fitted to the training rows by least squares.
  Tree fitted(const Tree& simple);

 private:
  std::vector<std::vector<double>> columns_;
  ConstantFit fit_;
};

}  // namespace demecal
