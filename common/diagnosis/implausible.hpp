// Effects that are larger than any real arm has: what they say of the data instead.
#pragma once

#include <string>
#include <vector>

#include "diagnosis/diagnosed_model.hpp"

namespace demecal {

/// Why no real arm has this effect, and what to look at; empty where one may. `states` are those of the fitted poses. A
/// joint that moves by a whole share of another's motion, which `model` with it bears out, is how the controller
/// reports its joints: the sentence says so.
std::string implausibility(const Effect& effect, const DiagnosisData& of, const DiagnosedModel& model,
                           const std::vector<ArmState>& states);

}  // namespace demecal
