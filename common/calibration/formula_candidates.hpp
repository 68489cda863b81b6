// From what islands evolved on the residual to symbolic effects that compete in the closed loop.
#pragma once

#include <vector>

#include "calibration/formula_tables.hpp"
#include "diagnosis/candidates.hpp"
#include "evolution/individual.hpp"

namespace demecal {

/// The shortest and best formulas of a joint's front as symbolic effects: constants polished, neutral ones and repeats
/// left out, each priced by the length of its description; at most `most`.
std::vector<Candidate> formula_candidates(const FormulaTable& table, const Population& front, std::size_t most);

}  // namespace demecal
