// What studies and comparisons found, as tables for a terminal.
#pragma once

#include <string>

#include "report/evaluation.hpp"
#include "report/study.hpp"

namespace demecal {

/// A line for every cell, with medians over its seeds and how sure they are, in words below.
std::string study_table(const Study& study);

/// The first `most` blocks, a line each; a sentence where there are none.
std::string blocks_table(const Study& study, std::size_t most);

/// A line per method: validation and accept error, numbers identified, time. At most 100 columns wide.
std::string comparison_table(const Comparison& comparison);

}  // namespace demecal
