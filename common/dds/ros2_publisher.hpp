// What a watcher sees, for programs of ROS 2 and any other DDS program: topics without keys, by ROS 2's names and
// types.
#pragma once

#include <memory>
#include <string>

#include "dds/dds_transport.hpp"
#include "protocol/messages.hpp"

namespace demecal::inline dds {

/// Publishes on rt/demecal/worker, run_state, progress, loop, cause and final_figures (idl/ros2.idl; ROS 2 packages are
/// built of configs/ros2/demecal) and on rt/demecal/events, as std_msgs/String, each event as a line of JSON. Reliable,
/// transient local, and of each topic the last kRos2Depth samples: no reader holds it up.
class Ros2Publisher {
 public:
  /// Joins the domain as a participant of its own. Throws std::runtime_error where Fast DDS refuses, InputError where
  /// an address is none.
  explicit Ros2Publisher(const DdsOptions& options);
  ~Ros2Publisher();
  Ros2Publisher(const Ros2Publisher&) = delete;
  Ros2Publisher& operator=(const Ros2Publisher&) = delete;

  /// `line` is the event's; an empty one says that the message concerns nobody.
  void publish(const Message& message, const std::string& line);

 private:
  class Implementation;
  std::unique_ptr<Implementation> implementation_;
};

inline constexpr int kRos2Depth = 500;

}  // namespace demecal::inline dds
