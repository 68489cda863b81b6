// The search for formulas outside the catalogue in what a model leaves, and how much the same search finds by luck.
#pragma once

#include <vector>

#include "calibration/evolver.hpp"
#include "diagnosis/candidates.hpp"
#include "residuals/diagnosed_model.hpp"

namespace demecal {

struct FormulaSearch {
  std::vector<Candidate> formulas;  ///< the best description first; empty: nothing that luck would not find too
  std::vector<double> luck_nats;    ///< the best fall of every search on permuted residuals, ascending
};

/// Evolves formulas on what `model` leaves of every joint's error, and runs the very same search, islands included, on
/// residuals dealt out anew among the poses (Freedman and Lane, 1983): as often as a p-value of `family_error` takes,
/// 19 times for 0.05. Found are formulas whose fall in description length is beyond that of every such search: with its
/// own counted in, theirs is the only one of so many. Nothing is permuted where no formula shortens the description,
/// and nothing is found where evolution is cut off. `terms` are those of every search but for its purpose.
/// `family_error` is below 0.5.
FormulaSearch search_formulas(const DiagnosisProblem& of, const DiagnosedModel& model, Evolver& evolver,
                              EvolutionTerms terms, double family_error, RandomStream random);

}  // namespace demecal
