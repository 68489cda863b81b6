// Finished jobs beside each other: their error figures, as their reports state them.
#pragma once

#include <string>
#include <utility>
#include <vector>

namespace demecal::inline serving {

/// One JSON document with a row for each job, from its name and the text of its report.json: method, seed and errors
/// with the base fitted, before the closed loop and after it, set by set. A report that cannot be read gives a row that
/// says so.
std::string comparison_text(const std::vector<std::pair<std::string, std::string>>& reports);

}  // namespace demecal::inline serving
