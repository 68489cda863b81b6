// What islands learn from when a formula outside the catalogue is sought: the residual as an error of each joint, over
// everything that it may depend on.
#pragma once

#include <vector>

#include "diagnosis/diagnosed_model.hpp"
#include "evolution/fitness.hpp"

namespace demecal {

/// One joint's table. Variables are those of symbolic_variables: q1 .. qn (rad or m), tau, s, T.
struct FormulaTable {
  int joint = 0;  ///< from 0
  TrainingTable table;
  double scale_rad = 1.0;           ///< of the target: its weighted mean absolute value
  double reference_celsius = 20.0;  ///< that T counts from
};

/// The least-squares residual of the model at every fitted pose, laid at one revolute joint after another: the angle
/// that explains most of it. Poses at which the joint hardly moves what is measured count less.
std::vector<FormulaTable> formula_tables(const DiagnosisData& of, const DiagnosedModel& model);

}  // namespace demecal
