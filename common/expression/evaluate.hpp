// The value of a formula: at one point, and over all rows of a table.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "expression/aligned_column.hpp"
#include "expression/column_steps.hpp"
#include "expression/tree.hpp"

namespace demecal {

/// The value at one point; `variables[i]` is the value of variable i. The tree must be valid for as many variables.
double evaluate(std::span<const Node> tree, std::span<const double> variables);

/// Columns of equal length, one per variable.
using Columns = std::span<const std::vector<double>>;

/// A copy of columns, each padded to whole vectors of rows by its last row.
class PaddedColumns {
 public:
  explicit PaddedColumns(Columns columns);

  std::size_t rows() const { return rows_; }
  std::size_t padded_rows() const { return padded_rows_; }
  const double* column(std::size_t variable) const { return values_.data() + variable * padded_rows_; }

 private:
  std::size_t rows_;
  std::size_t padded_rows_;
  AlignedColumn values_;  ///< the columns one after the other
};

/// Evaluates formulas over the same columns one by one, keeping its scratch memory between calls. Rows get the same
/// bits as evaluate() gives.
class ColumnEvaluator {
 public:
  /// Keeps a copy of the columns.
  explicit ColumnEvaluator(Columns columns) : columns_(columns), result_(columns_.padded_rows()) {}

  /// One value per row; valid until the next call. The tree must be valid for as many variables as there are columns.
  std::span<const double> operator()(std::span<const Node> tree) { return padded_values(tree).first(columns_.rows()); }
  /// The same with the padding: the last row's value until kLanes divides their number.
  std::span<const double> padded_values(std::span<const Node> tree);

 private:
  Operand make_steps(std::span<const Node> tree);

  PaddedColumns columns_;
  AlignedColumn result_;
  std::vector<Operand> operands_;  ///< a stack, deep enough for the largest tree so far
  std::vector<Step> steps_;
  AlignedColumn scratch_;  ///< a strip of rows for each operand
};

}  // namespace demecal
