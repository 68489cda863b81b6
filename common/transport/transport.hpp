// How messages travel: one participant's end of the topics, whatever carries them.
#pragma once

#include <chrono>
#include <memory>
#include <optional>
#include <string>

#include "protocol/messages.hpp"

namespace demecal {

/// What a participant reads and writes: coordinators write data, tasks and control and read the rest but migrants;
/// workers the reverse, with migrants both ways; watchers read everything and write nothing.
enum class Role { coordinator, worker, watcher };

/// One participant. publish() and receive() may be called from different threads; each of them from one at a time.
/// Every message is delivered to all participants whose role reads it, never to the sender. Those who come late get the
/// last value of every key of data, tasks, control, progress, outcomes and worker status, and the last `kMigrantEpochs`
/// migrants of every island whose joint they follow.
class Transport {
 public:
  virtual ~Transport() = default;

  virtual void publish(const Message& message) = 0;
  /// The next message, or nothing after `patience`.
  virtual std::optional<Message> receive(std::chrono::milliseconds patience) = 0;
  /// From now on migrants of this joint (counted from 0) are received, and can be published.
  virtual void follow_migrants(std::uint32_t joint) = 0;
  /// A sign of life, due at least every third of kLease from each worker's own work loop.
  virtual void assert_alive() = 0;
  /// Whether all that was published has reached those who read it, within `patience`.
  virtual bool flush(std::chrono::milliseconds patience) = 0;
};

inline constexpr std::chrono::milliseconds kLease{2000};

}  // namespace demecal
