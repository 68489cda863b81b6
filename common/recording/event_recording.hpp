// What a watcher sees, as an MCAP file: a channel for each kind of event, and for each island one of its own, so that
// viewers plot its figures.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "monitor/events.hpp"
#include "protocol/messages.hpp"
#include "recording/mcap.hpp"

namespace demecal::inline recording {

class EventRecording {
 public:
  /// `begin_ns` is the moment from which times count, in ns since 1970.
  explicit EventRecording(std::uint64_t begin_ns);

  void take(const Message& message, double now_s);
  /// What is to be written by now: everything up to the last chunk, which ends once a second or when it is large.
  std::string due_bytes(double now_s);
  /// The rest of the file.
  std::string finish();

 private:
  std::uint16_t channel_of(const std::string& word, const std::string& topic);

  std::uint64_t begin_ns_;
  McapWriter writer_;
  std::map<std::string, std::uint16_t> schemas_;   ///< by word
  std::map<std::string, std::uint16_t> channels_;  ///< by topic
  double chunk_began_s_ = 0.0;
};

/// What is whole of such a file.
struct RecordedEvents {
  std::vector<Event> events;
  std::vector<std::string> losses;  ///< for people: which bytes are damaged, and how much time is missing
};
/// Throws InputError naming the file where it is none, or nothing in it is whole.
RecordedEvents read_recording(std::string_view bytes, const std::string& file);

}  // namespace demecal::inline recording
