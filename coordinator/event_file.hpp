// A run as it is recorded for `demecal monitor --replay`: events.jsonl in the folder of results.
#pragma once

#include <chrono>
#include <fstream>
#include <string>
#include <vector>

#include "monitor/events.hpp"

namespace demecal {

inline constexpr const char* kEventFile = "events.jsonl";

/// Appends events as they happen, each at once. It is for people alone: where it cannot be written nothing is, and the
/// run goes on.
class EventFile {
 public:
  /// `resume` goes on after the whole events that the file holds, in their time; otherwise it begins anew.
  EventFile(const std::string& path, bool resume);

  void note(const Message& message);

 private:
  std::ofstream file_;
  std::chrono::steady_clock::time_point begin_;
};

/// The events of a recorded run, in the order of the file; a last line that was not written to its end is left out.
/// Throws InputError naming file and line where the file cannot be read or holds something else.
std::vector<Event> read_events(const std::string& path);

}  // namespace demecal
