// A robot's checks as one web page: a control chart and the record behind it.
#pragma once

#include <string>
#include <vector>

#include "report/change_report.hpp"

namespace demecal::inline html {

/// A self-contained HTML page: how far each check strayed from the model, beside the limit that one unchanged robot in
/// a thousand exceeds. `records` are in the order of the checks, one at least.
std::string check_history_html(const std::vector<CheckRecord>& records);

}  // namespace demecal::inline html
