// The backward step: takes back effects that are no longer needed beside the others.
#pragma once

#include "diagnosis/candidates.hpp"
#include "diagnosis/diagnosed_model.hpp"
#include "diagnosis/outcome.hpp"

namespace demecal {

/// Drops effects one after another, the least needed first, as long as the description length falls by it, and refines
/// the model after each. Dropped effects are noted in the outcome. Returns the surroundings of the model that is left.
Linearised take_back_needless(const DiagnosisData& of, DiagnosedModel& model, const std::vector<Candidate>& candidates,
                              LoopOutcome& outcome);

}  // namespace demecal
