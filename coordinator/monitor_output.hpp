// Messages on their way from a monitor to people and programs: a terminal, lines of JSON, a page for browsers, a file.
#pragma once

#include <chrono>
#include <fstream>
#include <optional>
#include <string>

#include "coordinator/displays.hpp"
#include "coordinator/keyboard.hpp"
#include "coordinator/live_page.hpp"
#include "dds/dds_transport.hpp"
#include "dds/ros2_publisher.hpp"
#include "monitor/watched.hpp"
#include "protocol/messages.hpp"
#include "recording/event_recording.hpp"

namespace demecal {

struct MonitorOptions {
  bool json = false;                         ///< a line for each event instead of pages
  bool once = false;                         ///< the present state, then the end
  std::chrono::milliseconds patience{5000};  ///< how long `once` waits for the present state to be complete
  double speed = 1.0;                        ///< of a recorded run: how much faster than it was
  std::string place;                         ///< where one watches, for people: "domain 3"
  std::string http;                          ///< where a page is served to browsers; empty: nowhere
  std::string token_file;                    ///< of it
  std::string data_file, model_file;         ///< whose arm and poses the page shows; empty: none
  std::string record;                        ///< the file that is recorded to; empty: none
  const DdsOptions* ros2 = nullptr;          ///< where it is published for ROS 2; null: nowhere
};

/// An MCAP file that grows as events come. Where it cannot be written any more, that is said once, and the rest goes
/// on.
class RecordingFile {
 public:
  /// Throws ArgumentError where a file that is no recording stands there, InputError where none can be written.
  explicit RecordingFile(const std::string& path);

  void take(const Message& message, double now_s) {
    recording_.take(message, now_s);
    tick(now_s);
  }
  /// To be called now and then.
  void tick(double now_s) { write(recording_.due_bytes(now_s)); }
  /// Ends the file.
  void finish() { write(recording_.finish()); }

 private:
  void write(const std::string& bytes);

  std::string path_;
  std::ofstream file_;
  EventRecording recording_;
};

class MonitorOutput {
 public:
  explicit MonitorOutput(const MonitorOptions& options);

  void take(const Message& message, double now_s);
  /// To be called now and then.
  void show(double now_s);
  /// The state as it is left.
  void finish(double now_s);
  /// Whether the key was pressed that leaves the monitor; what it watches goes on.
  bool is_left() const { return is_left_; }
  const Watched& watched() const { return watched_; }

 private:
  void follow_keys();

  const MonitorOptions& options_;
  std::optional<RecordingFile> recording_;
  std::optional<LivePage> page_;
  std::optional<Ros2Publisher> ros2_;
  MonitorScreen screen_;
  std::optional<Keyboard> keyboard_;  ///< after the screen: given back before it
  bool is_left_ = false;
  Watched watched_;
  bool changed_ = true;
};

}  // namespace demecal
