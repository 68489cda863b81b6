// The sum that fitness is: weighted absolute errors, added in the same order on every machine.
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "expression/evaluate.hpp"

namespace demecal {

/// sum_k weight_k |target_k - value_k| (thesis eq. 4.12). Rows are added by turns into kLanes sums, and those pairwise.
class ErrorSum {
 public:
  using Lanes = std::array<double, kLanes>;

  /// Keeps copies of the columns, which are of equal length.
  ErrorSum(const std::vector<double>& target, const std::vector<double>& weight);

  /// Adds the rows from `begin` on, `rows` of them, both multiples of kLanes. Rows beyond the last must repeat its
  /// value.
  void add(Lanes& sums, std::size_t begin, const double* values, std::size_t rows) const;
  /// The whole sum; infinite where any row's value is not finite, be its weight zero.
  static double total(const Lanes& sums);

 private:
  AlignedColumn target_, weight_;  ///< padded to whole vectors, without weight
};

}  // namespace demecal
