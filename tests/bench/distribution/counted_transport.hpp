// The coordinator's transport with a count of what passes through it.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "forwarding_transport.hpp"

namespace demecal::bench {

struct Traffic {
  std::size_t messages = 0;
  std::size_t bytes = 0;  ///< of the messages alone, without the headers of their packets
};

/// Waits for workers before the run that is measured begins, and hands their words on to it.
class CountedTransport : public ForwardingTransport {
 public:
  using ForwardingTransport::ForwardingTransport;

  /// Whether so many workers have reported within `patience`.
  bool await_workers(std::size_t count, std::chrono::milliseconds patience);
  const std::map<std::string, WorkerStatus>& workers() const { return workers_; }
  /// What islands have said: progress, checkpoints, outcomes, and the migrants that neighbours of other workers got,
  /// those by the tasks and of the size of the last.
  Traffic traffic(const CalibrationData& data) const;
  /// Processor time that counting took, s.
  double counting_s() const { return counting_s_; }

  void publish(const Message& message) override;
  std::optional<Message> receive(std::chrono::milliseconds patience) override;

 private:
  std::map<std::string, WorkerStatus> workers_;
  std::map<std::string, WorkerStatus> to_tell_;
  std::map<IslandKey, std::string> holders_;
  std::vector<Message> received_;  ///< counted when the run is over, not to take its time
  double counting_s_ = 0.0;
};

std::size_t epochs_of(const CalibrationData& data);

}  // namespace demecal::bench
