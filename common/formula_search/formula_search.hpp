// The search for formulas outside the catalogue in a model's residuals, and its null distribution: what the same search
// finds in permuted residuals.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "calibration/evolver.hpp"
#include "diagnosis/candidates.hpp"
#include "evolution/population.hpp"
#include "expression/tree.hpp"
#include "fitness/fitness.hpp"
#include "formula_search/misfit.hpp"
#include "random/random_stream.hpp"
#include "residuals/diagnosed_model.hpp"

namespace demecal::inline formula_search {

/// One joint's table. Its variables are those of symbolic_variables that these poses know and that vary: joints that
/// move (rad or m), gravity's torque where masses are known, approach signs and temperatures where they were recorded.
struct FormulaTable {
  int joint = 0;                        ///< from 0
  std::vector<std::uint8_t> variables;  ///< of every column, its place in symbolic_variables
  TrainingTable table;
  double scale_rad = 1.0;                     ///< of the target: its weighted mean absolute value
  std::optional<double> reference_celsius{};  ///< that T counts from, where it is a variable
};

/// `residual`, what a model leaves at its fitted poses (rows of the field), laid at one revolute joint after another:
/// the angle that explains most of it. Poses at which the joint hardly moves what is measured count less.
std::vector<FormulaTable> formula_tables(const DiagnosisProblem& problem, const Linearization& linearization,
                                         const Eigen::VectorXd& residual);

/// A formula of the table's variables in those of symbolic_variables.
Tree in_symbolic_variables(Tree formula, const FormulaTable& table);

/// A formula, and by how much it shortens the description: likelihood won, less its price.
struct PricedFormula {
  Candidate candidate;
  double gain_nats = 0.0;
};

/// What rewriting makes of a joint's front as symbolic effects, the best description first: of the `most` / 2 shortest
/// members and of those that fit best for their length, `most` together, and of the best product; those that explain
/// the same as a better one (cosine 0.9) are left out. None where the front is empty: where nothing was evolved. Each
/// is priced by one coefficient, the joint (one of `joints`) and the length of its description. `misfit` is of the same
/// joint.
std::vector<PricedFormula> formula_candidates(const FormulaTable& table, const Population& front, FormulaMisfit& misfit,
                                              std::size_t joints, std::size_t most);

struct FormulaSearch {
  std::vector<Candidate> formulas;  ///< the best description first; empty: nothing significant
  std::vector<double> null_nats;    ///< the best gain of every search on permuted residuals, ascending
};

/// Evolves formulas on what `model` leaves of every joint's error, and runs the very same search, islands included, on
/// residuals dealt out anew among the poses (Freedman and Lane, 1983): as often as a p-value of `family_error` takes,
/// 19 times for 0.05. Found are formulas whose fall in description length is beyond that of every such search: with its
/// own counted in, theirs is the only one of so many. Nothing is permuted where no formula shortens the description,
/// and nothing is found where evolution is cut off. `terms` are those of every search but for its purpose.
/// `family_error` is below 0.5.
FormulaSearch search_formulas(const DiagnosisProblem& problem, const DiagnosedModel& model, Evolver& evolver,
                              EvolutionTerms terms, double family_error, RandomStream random);

}  // namespace demecal::inline formula_search
