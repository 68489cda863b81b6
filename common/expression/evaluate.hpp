// The value of a formula: at one point, and over all rows of a table.
#pragma once

#include <span>
#include <vector>

#include "expression/tree.hpp"

namespace demecal {

/// The value at one point; `variables[i]` is the value of variable i.
double evaluate(std::span<const Node> tree, std::span<const double> variables);

/// Columns of equal length, one per variable.
using Columns = std::span<const std::vector<double>>;

/// Evaluates formulas row by row over the same columns, keeping its scratch memory between calls. Rows get the same
/// bits as evaluate() gives.
class ColumnEvaluator {
 public:
  explicit ColumnEvaluator(Columns columns);

  /// One value per row; valid until the next call.
  std::span<const double> operator()(std::span<const Node> tree);

 private:
  Columns columns_;
  std::size_t rows_;
  std::vector<double> stack_;
};

}  // namespace demecal
