// The report as one web page for calibration engineers.
#pragma once

#include <string>

#include "report/history.hpp"
#include "report/report.hpp"

namespace demecal::inline html {

/// A self-contained HTML page (its own style, pictures and scripts, nothing loaded from elsewhere; light or dark as
/// the reader prefers, and printable). What is missing is left out of the page, as are charts of a history without
/// rows. Formulas that cannot be read are shown without their plot.
std::string report_html(const Report& report, const FitnessHistory& history);

}  // namespace demecal::inline html
