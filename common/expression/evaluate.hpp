// The value of a formula: at one point, and over all rows of a table.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "expression/aligned_column.hpp"
#include "expression/tree.hpp"

namespace demecal {

/// The value at one point; `variables[i]` is the value of variable i. The tree must be valid for as many variables.
double evaluate(std::span<const Node> tree, std::span<const double> variables);

/// Columns of equal length, one per variable.
using Columns = std::span<const std::vector<double>>;

/// What a function takes in every row: a column or, without one, a constant.
struct Operand {
  const double* column = nullptr;
  double constant = 0.0;
};

/// Evaluates formulas row by row over the same columns, keeping its scratch memory between calls. Rows get the same
/// bits as evaluate() gives.
class ColumnEvaluator {
 public:
  /// Keeps a copy of the columns, padded to whole vectors of rows.
  explicit ColumnEvaluator(Columns columns);

  /// One value per row; valid until the next call. The tree must be valid for as many variables as there are columns.
  std::span<const double> operator()(std::span<const Node> tree);

 private:
  std::size_t rows_;
  std::size_t padded_rows_;
  AlignedColumn columns_;  ///< of padded_rows_ each, one after the other
  AlignedColumn result_;
  std::vector<Operand> operands_;  ///< a stack, deep enough for the largest tree so far
  AlignedColumn scratch_;          ///< a strip of rows for each operand
};

}  // namespace demecal
