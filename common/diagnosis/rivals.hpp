// Which candidates would explain the same as a named one, so that these poses cannot tell them apart.
#pragma once

#include <vector>

#include "diagnosis/candidates.hpp"
#include "diagnosis/outcome.hpp"
#include "diagnosis/scan.hpp"

namespace demecal {

/// Candidates other than `named` whose cosine with it is above 0.9, or whose description length is within 5 nats of its
/// own at a cosine above one half; nearest first, at most eight.
/// Formulas outside the catalogue are rivals only of each other. The cosine is between what the named one explains
/// beyond the model and the best that the rival can make of it.
std::vector<Rival> rivals_of(std::size_t named, const Projection::Trial& explained, const std::vector<Candidate>& all,
                             const std::vector<Score>& scores, const Scan& scan, const EffectColumns& columns,
                             const ResidualField& field);

}  // namespace demecal
