// Fits the constants of formulas to a training table: by steps of Levenberg and Marquardt or, where a constant decides
// where a SIGN jumps, by a simplex too.
#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include "evolution/error_sum.hpp"
#include "evolution/fitness.hpp"
#include "evolution/normal_equations.hpp"
#include "evolution/parameters.hpp"
#include "evolution/simplex_search.hpp"
#include "expression/constant_model.hpp"

namespace demecal {

/// A formula whose constants are fitted, and what its fit reached.
struct FittedFormula {
  NodeId root = 0;
  double fitness = 0.0;
};

/// Fits one formula at a time to what fitness is: the weighted sum of squared errors or, where the table's loss is
/// absolute, of absolute ones, by least squares whose weights are divided by the size of each row's error
/// (Schlossmacher 1973). A step that does not lower that sum is taken back. What comes out is a function of table,
/// parameters and formula.
class ConstantFit {
 public:
  ConstantFit(const TrainingTable& table, const GpParameters& parameters);

  /// The formula with constant_steps steps made on its constants, folded; where linear_scaling is on and the limits of
  /// depth and size allow it, as a + b * formula, a and b first at their least-squares values. `fitness` is that of
  /// `root`, which comes back unchanged where nothing better was found.
  FittedFormula operator()(NodeStore& store, NodeId root, double fitness);

  /// The same by the sum of squared errors, which is what is returned beside the formula: for normal noise, once the
  /// formula is chosen.
  FittedFormula by_squares(NodeStore& store, NodeId root);

 private:
  ConstantModel::Scaling scaling_for(const NodeStore& store, NodeId root) const;
  double loss_at(std::span<const double> constants);
  void scale();
  void sum_products();
  void fit();
  bool step(double& damping);
  void search_jumps();

  std::size_t rows_;
  AlignedColumn target_, weight_;  ///< padded, without weight
  double weights_ = 0.0;
  ErrorSum errors_;
  GpParameters parameters_;
  ConstantModel model_;
  NormalEquations equations_;
  SimplexSearch simplex_;
  Loss own_loss_, loss_kind_;  ///< the table's, and that of the present fit
  std::vector<double> constants_, trial_, step_;
  std::vector<const double*> slopes_;
  std::size_t unknowns_ = 0;
  double loss_ = 0.0;
  bool products_known_ = false;  ///< the equations' sums, at constants_
  bool at_constants_ = false;    ///< whether the model has them
};

}  // namespace demecal
