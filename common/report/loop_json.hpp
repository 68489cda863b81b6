// What the closed loop did, as the report's JSON has it.
#pragma once

#include <nlohmann/json_fwd.hpp>

#include "diagnosis/outcome.hpp"

namespace demecal {

/// Sets rounds, dropped, not_found, unseen, decoys, stopped, lack_of_fit_p, explained_share, structure_left_p (null
/// where the loop did not run), candidates and permutations of `report`. `described` is the arm that the effects stand
/// by; numbers that are not finite are null.
void add_loop(const LoopOutcome& loop, const Robot& described, nlohmann::ordered_json& report);

}  // namespace demecal
