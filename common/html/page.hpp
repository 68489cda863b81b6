// Web pages, each self-contained: a report, a plan, and a robot's checks.
#pragma once

#include <string>
#include <vector>

#include "planning/plan.hpp"
#include "report/history.hpp"
#include "report/report.hpp"
#include "studies/change_report.hpp"

namespace demecal::inline html {

/// A self-contained HTML page (its own style, pictures and scripts, nothing loaded from elsewhere; light or dark as
/// the reader prefers, and printable). What is missing is left out of the page, as are charts of a history without
/// rows. Formulas that cannot be read are shown without their plot.
std::string report_html(const Report& report, const FitnessHistory& history);

/// A self-contained HTML page: predicted error against the number of poses, what will be known and what not, the arm
/// and the poses from above and from the side.
std::string plan_html(const Plan& plan, const PlanRequest& request);

/// A self-contained HTML page: how far each check strayed from the model, beside the limit that one unchanged robot in
/// a thousand exceeds. `records` are in the order of the checks, one at least.
std::string check_history_html(const std::vector<CheckRecord>& records);

}  // namespace demecal::inline html
