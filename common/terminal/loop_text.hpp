// What the closed loop found, as a person reads it in a terminal.
#pragma once

#include <string>

#include "report/report.hpp"

namespace demecal {

/// One line per effect added with its size, p and the validation error before and after (many gear harmonics take one
/// line per joint), what it may be taken for, what to measure next, what was tried last, why the loop stopped, and
/// what was not found. At most kTerminalColumns wide; empty where the loop did not run.
std::string loop_to_terminal(const Report& report);

/// The part of it that says what the loop could not find or not see, how measurements scatter together, and how the
/// controls fared: a few kinds that people ask for first have a line each, "no backlash: joint 2 below 8 arcsec", or
/// between which limits where several places were searched.
std::string limits_to_terminal(const Report& report);

}  // namespace demecal
