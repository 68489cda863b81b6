// Effects that are larger than any real arm has: what they say of the data instead.
#pragma once

#include <string>
#include <vector>

#include "effects/effect.hpp"

namespace demecal {

/// Why no real arm has this effect, and what to look at; empty where one may. A joint that moves by a whole share of
/// another's motion is how the controller reports its joints, which the sentence says.
std::string implausibility(const Effect& effect, const Robot& robot, const std::vector<ArmState>& states);

/// A mount is known to a few degrees: whether gravity must lean more, so that the effect is another one in disguise.
bool leans_too_far(const Effect& effect);

}  // namespace demecal
