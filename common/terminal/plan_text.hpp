// What a terminal shows of a plan.
#pragma once

#include <string>

#include "planning/plan.hpp"

namespace demecal::inline terminal {

/// What is planned and what it is predicted to reach, what may be wrong with it, what it cannot tell and what it rests
/// on. At most kTerminalColumns wide.
std::string to_terminal(const Plan& plan, const PlanRequest& request);

}  // namespace demecal::inline terminal
