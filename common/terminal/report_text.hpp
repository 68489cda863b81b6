// The report as tables for a terminal.
#pragma once

#include <string>

#include "report/evaluation.hpp"
#include "report/report.hpp"

namespace demecal {

/// Mean, rms, P95 and max in mm of every stage on every set that has poses; the joints' errors in rad; what the poses
/// could not see; what was named. At most 100 columns wide.
std::string to_terminal(const Report& report);

/// One stage's figures, and how far single poses are predicted to err, where that is known.
std::string to_terminal(const Evaluation& evaluation);

/// What the check of the data found: a sentence a line, the gravest first, at most 100 columns wide; empty where
/// nothing was found.
std::string to_terminal(const DataCheckEntry& check);

}  // namespace demecal
