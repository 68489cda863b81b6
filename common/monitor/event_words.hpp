// The words that events, stages and verdicts have in lines for other programs.
#pragma once

#include <string>

#include "protocol/messages.hpp"

namespace demecal {

inline constexpr int kEventsVersion = 1;

/// "run", "progress", "run_state", "worker", "worker_lost", "stage", "round", "calibration_lost"; empty for messages
/// that do not concern people.
const char* event_word(const Message& message);

/// "preparing", "evolving", "closing", "finished", "interrupted", "failed".
std::string word_of(LoopNews::Stage stage);
/// "added", "rejected", "none".
std::string word_of(LoopNews::Verdict verdict);
/// "running", "finished", "cancelled".
std::string word_of(Control::State state);

}  // namespace demecal
