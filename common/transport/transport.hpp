// How messages travel: one participant's end of the topics, whatever carries them; and the transport inside one
// process.
#pragma once

#include <chrono>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>

#include "protocol/messages.hpp"

namespace demecal::inline transport {

/// One participant. publish() and receive() may be called from different threads; each of them from one at a time.
/// Every message is delivered to all participants whose role reads it, never to the sender. Those who come late get the
/// last value of every key of data, tasks, control, progress, checkpoints, outcomes, worker status and loop news, and
/// the last `kMigrantEpochs` migrants of every island whose joint they follow: as long as the sender takes part, and
/// until a Control says that the run is over. Tasks and control of a run are delivered after its data and only from the
/// participant that published those (see RunOwners). A slow reader may miss values between, never the last; there is no
/// order between topics. Watchers hold nobody up: they may miss control and worker status, and nobody waits for them.
class Transport {
 public:
  virtual ~Transport() = default;

  virtual void publish(const Message& message) = 0;
  /// The next message, or nothing after `patience`.
  virtual std::optional<Message> receive(std::chrono::milliseconds patience) = 0;
  /// Makes a receive() that waits return at once, with nothing; may be called from any thread.
  virtual void wake() = 0;
  /// From now on migrants of this joint (counted from 0) are received.
  virtual void follow_migrants(std::uint32_t joint) = 0;
  /// From now on migrants of this joint can be published. Who only publishes is not sent what others publish.
  virtual void offer_migrants(std::uint32_t joint) = 0;
  /// A sign of life, due at least every third of kLease from each worker's own work loop. From time to time it repeats
  /// the last WorkerStatus, which others receive only if they took the worker for lost.
  virtual void assert_alive() = 0;
  /// Whether all that was published has reached those who read it, within `patience`; save for data and progress, since
  /// whoever still reads those only watches.
  virtual bool flush(std::chrono::milliseconds patience) = 0;
  /// A number for a run that this participant will publish: different every time, and on every host.
  virtual RunId new_run() = 0;
  /// Counts a message from `source` (a worker's name, or words for another) that its receiver does not act on; the
  /// first from each source that has a name is logged on standard error with the reason.
  virtual void reject(const std::string& /*source*/, const std::string& /*why*/) {}
  /// Messages rejected so far: by the receiver, and those that could not be read, came from a participant that may not
  /// publish them, or from one that sends more than can be kept.
  virtual std::uint64_t rejected() const { return 0; }
};

inline constexpr std::chrono::milliseconds kLease{2000};

class Exchange;  ///< what the DDS domain is to the other: where in-memory participants meet

std::shared_ptr<Exchange> make_exchange();
/// Joins the exchange. `name` identifies a worker: when its transport is destroyed without a WorkerStatus that says
/// `leaving`, the others receive WorkerLost{name}.
std::unique_ptr<Transport> join(std::shared_ptr<Exchange> exchange, Role role, const std::string& name);

}  // namespace demecal::inline transport
