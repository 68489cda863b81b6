// Fits the constants of formulas to a training table: by steps of Levenberg and Marquardt or, where a constant decides
// where a SIGN jumps, by a simplex too.
#pragma once

#include <array>
#include <cstddef>
#include <functional>
#include <span>
#include <vector>

#include "expression/constant_model.hpp"
#include "expression/node_store.hpp"
#include "fitness/fitness.hpp"
#include "fitness/parameters.hpp"
#include "primitives/columns.hpp"

namespace demecal::inline fitness {

/// (J' W J + damping diag(J' W J)) x = J' W e, where column i of J is the slope of the values by unknown i and e are
/// the errors left (Marquardt 1963). Keeps its memory.
class DampedNormalEquations {
 public:
  static constexpr std::size_t kMostRowsAtOnce = 256;
  using Strip = std::array<double, kMostRowsAtOnce>;  ///< a number of each row

  void clear(std::size_t unknowns);
  /// Adds rows, a multiple of kLanes and at most kMostRowsAtOnce; slopes[i] is column i of J.
  void add(std::span<const double* const> slopes, const double* error, const double* weight, std::size_t rows);
  /// Ends the sums. False where one is not finite.
  bool finish();
  /// The step; 0 for unknowns that change nothing. False where it is not finite. After finish().
  bool solve(double damping, std::span<double> step);

 private:
  using Lanes = std::array<double, kLanes>;
  std::size_t unknowns_ = 0;
  std::vector<Lanes> sums_;       ///< rows of the lower triangle, then one row for J' W e
  std::vector<double> products_;  ///< the same, ended
  std::vector<double> factor_;    ///< unknowns x unknowns, by rows
  std::vector<double> diagonal_;
};

/// Keeps its memory between searches.
class SimplexSearch {
 public:
  using Function = std::function<double(std::span<const double>)>;

  /// Moves `point`, whose value is `value`, to the best that `evaluations` calls find, and returns its value, never
  /// above `value`. Corners of the first simplex lie a tenth of each coordinate's size, and a tenth, away. Values that
  /// are not finite count as worst.
  double operator()(const Function& function, std::span<double> point, double value, int evaluations);

 private:
  std::span<double> corner(std::size_t i) { return {corners_.data() + i * unknowns_, unknowns_}; }
  std::size_t least() const;
  void start(const Function& function, std::span<const double> point, double value);
  void move(const Function& function);
  double try_at(const Function& function, double from_centre);
  void replace_worst(double value);
  void shrink(const Function& function, std::size_t best);

  std::size_t unknowns_ = 0;
  int left_ = 0;  ///< evaluations
  std::vector<double> corners_, values_, centre_, trial_;
  std::size_t worst_ = 0;
};

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

  AlignedColumn target_, weight_;  ///< padded, without weight
  double weights_ = 0.0;
  ErrorSum errors_;
  GpParameters parameters_;
  ConstantModel model_;
  DampedNormalEquations equations_;
  SimplexSearch simplex_;
  Loss own_loss_, loss_kind_;  ///< the table's, and that of the present fit
  std::vector<double> constants_, trial_, step_;
  std::vector<const double*> slopes_;
  std::size_t unknowns_ = 0;
  double loss_ = 0.0;
  bool products_known_ = false;  ///< the equations' sums, at constants_
  bool at_constants_ = false;    ///< whether the model has them
};

}  // namespace demecal::inline fitness
