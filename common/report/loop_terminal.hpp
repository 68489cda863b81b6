// What the closed loop found, as a person reads it in a terminal.
#pragma once

#include <string>

#include "diagnosis/outcome.hpp"

namespace demecal {

/// True where an effect is in the model that was not before.
bool loop_added(const LoopOutcome& loop);

/// One line per effect added with its size, p and the validation error before and after (many gear harmonics take one
/// line per joint), what it may be taken for, what to measure next, what was tried last, why the loop stopped, and
/// what was not found. At most kTerminalColumns wide; empty where the loop did not run.
std::string loop_to_terminal(const LoopOutcome& loop, const Robot& described);

}  // namespace demecal
