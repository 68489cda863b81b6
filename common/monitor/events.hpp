// Messages as lines of JSON for other programs, and back: what `monitor --json` prints and a recorded run consists of.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "protocol/messages.hpp"

namespace demecal::inline monitor {

inline constexpr int kEventsVersion = 1;

/// "preparing", "evolving", "closing", "finished", "interrupted", "failed".
std::string to_string(LoopNews::Stage stage);
/// "added", "rejected", "none".
std::string to_string(LoopNews::Verdict verdict);
/// "running", "finished", "cancelled".
std::string to_string(Control::State state);

/// The line that such a stream begins with; it names the format's version.
std::string first_event_line();

/// One line without its end: {"event": WORD, "t_s": ..., ...}. Empty for messages that do not concern people (tasks,
/// migrants, checkpoints, outcomes). Joints and islands count from 1, numbers of runs are texts (they have more digits
/// than some readers keep), figures that are not finite are null. Of a run's data the tables are left out.
std::string event_line(const Message& message, double time_s);

/// What the lines of a word hold, as JSON Schema of one line: every member with its type; those that may be null are of
/// that type where they are not.
struct EventSchema {
  std::string word;
  std::string json;
};
std::vector<EventSchema> event_schemas();

struct Event {
  double time_s = 0.0;
  Message message;
};

/// The event on a line of `file`; nothing for words that are not known here. Throws InputError naming file, line and
/// key where the line is no such event.
std::optional<Event> read_event(const std::string& text, const std::string& file, int line);

}  // namespace demecal::inline monitor
