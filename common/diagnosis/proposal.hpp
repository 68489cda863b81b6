// The poses that would tell most, were they measured next.
#pragma once

#include <vector>

#include "diagnosis/diagnosed_model.hpp"
#include "diagnosis/outcome.hpp"
#include "random/random_stream.hpp"

namespace demecal {

/// `count` feasible stops, the most telling first, picked greedily from a few thousand random ones so that the
/// determinant of what is then known of the coefficients asked about is largest (D-optimality), given what the poses at
/// hand know. Asked about are effects that were added, or considered last, and have rivals, and these rivals; where
/// there are none, all numbers of the model. Payloads are those recorded, approaches from both sides where they were
/// recorded; temperature and time are left open. Joints keep 2 % off their limits.
std::vector<Stop> propose_poses(const DiagnosisData& of, const DiagnosedModel& model, const std::vector<Round>& rounds,
                                int count, RandomStream random);

}  // namespace demecal
