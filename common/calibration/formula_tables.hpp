// What islands learn from when a formula outside the catalogue is sought: the residual as an error of each joint, over
// everything that it may depend on.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "evolution/fitness.hpp"
#include "residuals/diagnosed_model.hpp"

namespace demecal {

/// One joint's table. Its variables are those of symbolic_variables that these poses know and that vary: joints that
/// move (rad or m), gravity's torque where masses are known, approach signs and temperatures where they were recorded.
struct FormulaTable {
  int joint = 0;                        ///< from 0
  std::vector<std::uint8_t> variables;  ///< of every column, its place in symbolic_variables
  TrainingTable table;
  double scale_rad = 1.0;                     ///< of the target: its weighted mean absolute value
  std::optional<double> reference_celsius{};  ///< that T counts from, where it is a variable
};

/// `left`, what a model leaves at its fitted poses (rows of the field), laid at one revolute joint after another: the
/// angle that explains most of it. Poses at which the joint hardly moves what is measured count less.
std::vector<FormulaTable> formula_tables(const DiagnosisProblem& of, const Linearization& at,
                                         const Eigen::VectorXd& left);

/// A formula of the table's variables in those of symbolic_variables.
Tree in_symbolic_variables(Tree formula, const FormulaTable& table);

}  // namespace demecal
