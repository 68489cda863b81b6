// The report as one web page for calibration engineers.
#pragma once

#include <string>

namespace demecal {

/// A self-contained HTML page (its own style and pictures, no scripts, nothing loaded from elsewhere; light or dark as
/// the reader prefers, and printable) of what to_json() and history_csv() wrote. Of the JSON only `demecal_report: 1`
/// must be there; what is missing or null is left out of the page, as are charts of a history without rows. Formulas
/// that cannot be read are shown without their plot. Throws InputError naming report.json or history.csv and the value
/// where the text is no such file or a value is of another kind than its key asks for.
std::string report_html(const std::string& report_json, const std::string& history_csv);

}  // namespace demecal
