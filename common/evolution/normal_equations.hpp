// The normal equations of a weighted least-squares step, summed in the same order on every machine.
#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include "expression/column_steps.hpp"

namespace demecal {

/// (J' W J + damping diag(J' W J)) x = J' W e, where column i of J is the slope of the values by unknown i and e are
/// the errors left (Marquardt 1963). Keeps its memory.
class NormalEquations {
 public:
  static constexpr std::size_t kMostRowsAtOnce = 256;

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

}  // namespace demecal
