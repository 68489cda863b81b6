// From what islands evolved on the residual to symbolic effects that compete in the closed loop.
#pragma once

#include <vector>

#include "calibration/formula_misfit.hpp"
#include "calibration/formula_tables.hpp"
#include "diagnosis/candidates.hpp"
#include "evolution/population.hpp"

namespace demecal {

/// A formula, and by how much it shortens the description: likelihood won, less its price.
struct PricedFormula {
  Candidate candidate;
  double fall_nats = 0.0;
};

/// What rewriting makes of a joint's front as symbolic effects, the best description first: of the `most` / 2 shortest
/// members and of those that fit best for their length, `most` together, and of the best product; those that explain
/// the same as a better one (cosine 0.9) are left out. None where the front is empty: where nothing was evolved. Each
/// is priced by one coefficient, the joint (one of `joints`) and the length of its description. `misfit` is of the same
/// joint.
std::vector<PricedFormula> formula_candidates(const FormulaTable& table, const Population& front, FormulaMisfit& misfit,
                                              std::size_t joints, std::size_t most);

}  // namespace demecal
