// The coordinator's transport with a count of what passes through it.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "transport/transport.hpp"

namespace demecal::bench {

struct Traffic {
  std::size_t messages = 0;
  std::size_t bytes = 0;  ///< of the messages alone, without the headers of their packets
};

/// Waits for workers before the run that is measured begins, and hands their words on to it.
class CountedTransport : public Transport {
 public:
  explicit CountedTransport(Transport& carrier) : carrier_(carrier) {}

  /// Whether so many workers have reported within `patience`.
  bool await_workers(std::size_t count, std::chrono::milliseconds patience);
  const std::map<std::string, WorkerStatus>& workers() const { return workers_; }
  /// What islands have said: progress, checkpoints, outcomes, and the migrants that neighbours of other workers got,
  /// those by the tasks and of the size of the last.
  Traffic traffic(const CalibrationData& data) const;

  void publish(const Message& message) override;
  std::optional<Message> receive(std::chrono::milliseconds patience) override;
  void wake() override { carrier_.wake(); }
  void follow_migrants(std::uint32_t joint) override { carrier_.follow_migrants(joint); }
  void assert_alive() override { carrier_.assert_alive(); }
  bool flush(std::chrono::milliseconds patience) override { return carrier_.flush(patience); }
  RunId new_run() override { return carrier_.new_run(); }
  void reject(const std::string& source, const std::string& why) override { carrier_.reject(source, why); }
  std::uint64_t rejected() const override { return carrier_.rejected(); }

 private:
  Transport& carrier_;
  std::map<std::string, WorkerStatus> workers_;
  std::map<std::string, WorkerStatus> to_tell_;
  std::map<IslandKey, std::string> holders_;
  std::vector<Message> received_;  ///< counted when the run is over, not to take its time
};

std::size_t epochs_of(const CalibrationData& data);

}  // namespace demecal::bench
