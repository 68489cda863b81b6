// What a formula does to columns of rows, one function at a time: the vector kernels.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "expression/primitive.hpp"

namespace demecal {

inline constexpr std::size_t kLanes = 8;  ///< rows are padded to the widest vector there is

/// `rows` rounded up to whole vectors.
constexpr std::size_t padded(std::size_t rows) {
  return (rows + kLanes - 1) / kLanes * kLanes;
}

/// What a function takes in every row: a column, or where that is null, a constant. The column is that of a strip of
/// rows at a time, or the whole one, whose strip begins further on for later rows.
struct Operand {
  const double* column = nullptr;
  double constant = 0.0;
  bool whole = false;
};

/// A function of columns, ready to run.
struct Step {
  const double* left = nullptr;   ///< the one argument, or the column among the two
  const double* right = nullptr;  ///< the second where both are columns
  double* out = nullptr;
  double constant = 0.0;  ///< the argument that is no column
  std::uint8_t code = 0;  ///< which kernel
  bool left_whole = false, right_whole = false, out_whole = false;
};

/// A function of one column.
Step step_of(Primitive function, const Operand& argument, double* out, bool out_whole);
/// A function of two arguments, of which one at least is a column.
Step step_of(Primitive function, const Operand& left, const Operand& right, double* out, bool out_whole);

/// Runs the steps in turn over `rows` rows, a multiple of kLanes, from row `begin` of the whole columns. The bits of
/// every row are those that value_of() gives. A step's `out` may be one of its arguments.
void run(std::span<const Step> steps, std::size_t begin, std::size_t rows);

}  // namespace demecal
