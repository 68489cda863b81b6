// A plan as one web page.
#pragma once

#include <string>

#include "planning/plan.hpp"

namespace demecal::inline html {

/// A self-contained HTML page: predicted error against the number of poses, what will be known and what not, the arm
/// and the poses from above and from the side.
std::string plan_html(const Plan& plan, const PlanRequest& request);

}  // namespace demecal::inline html
