// What a monitor sees, for browsers: events at a pace that pages follow, and the present state; and the arm of a data
// set and where it was measured, for pages that draw it.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "http/live_server.hpp"
#include "monitor/paced_events.hpp"
#include "protocol/messages.hpp"

namespace demecal {

class LivePage {
 public:
  /// Serves at once at `where`, as --http takes it; to this machine alone without a token, otherwise only who shows the
  /// first line of `token_file` or, where that is empty, a token that is drawn. `place` says for people where it
  /// watches. Throws ArgumentError where `where` is no such place, InputError where the port is taken or the token is
  /// unfit.
  LivePage(const std::string& where, const std::string& token_file, std::string place);

  std::string address() const { return server_.address(); }

  /// Shows what concerns no message: an arm, as arm_event() gives it.
  void show_arm(std::string event) { server_.publish(std::move(event), ""); }

  void take(const Message& message, double now_s);
  /// To be called some times a second.
  void tick(double now_s);

 private:
  void publish(std::vector<PacedLine> lines);

  std::string place_;
  LiveServer server_;
  PacedEvents events_;
  bool changed_ = false;
  double state_set_s_ = 0.0;
};

/// A line {"event": "arm", ...} (docs/FORMATS.md, monitor --http): the arm at poses spread over those measured, where
/// they were measured, and by how much the robot of the file (its base and tool fitted to the calibration poses) misses
/// them; where `model_file` names a model of it, by how much that misses them, too. Throws InputError where a file is
/// missing or invalid, or no position was measured.
std::string arm_event(const std::string& data_file, const std::string& model_file);

}  // namespace demecal
