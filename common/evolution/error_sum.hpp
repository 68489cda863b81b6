// The sum that fitness is: weighted errors, absolute or squared, added in the same order on every machine.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "expression/evaluate.hpp"

namespace demecal {

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

}  // namespace demecal
