// The weight of links and payload as each joint feels it, summed link by link.
#pragma once

#include <vector>

#include "data/data_set.hpp"
#include "simulation/situation.hpp"

namespace demecal {

/// What gravity does to every joint of the nominal arm standing at `q` (rad or m) with `payload_kg` at its tool point:
/// the sum over all links the joint carries of weight and of lever x weight. Unknown masses weigh nothing.
std::vector<JointLoad> gravity_loads(const Robot& robot, const JointVector& q, double payload_kg);

}  // namespace demecal
