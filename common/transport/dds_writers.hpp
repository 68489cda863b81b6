// A participant's writers, and what they have said of runs that go on.
#pragma once

#include <chrono>
#include <deque>
#include <map>
#include <mutex>
#include <optional>
#include <utility>
#include <vector>

#include "transport/dds_participant.hpp"
#include "transport/topic.hpp"

namespace demecal {

/// What does not fit into a datagram travels in parts, and is not replaced before it has arrived: a reader that has
/// some of the parts may take them for the whole then, and abort (Fast DDS 2.9, StatefulReader::processGapMsg). But a
/// task does not wait for long: who has been stopped amid its parts is given no islands anyhow. Nothing is withdrawn
/// before all that its writer has said has arrived. Any thread may call.
class DdsWriters {
 public:
  /// A topic, and the joint (from 0) where it is migrants, else 0.
  using Place = std::pair<Topic, std::uint32_t>;

  void add(Place place, Owned<eprosima::fastdds::dds::DataWriter> writer);
  /// The writer of a place for which one was added.
  eprosima::fastdds::dds::DataWriter* at(Place place);
  std::vector<std::pair<Topic, eprosima::fastdds::dds::DataWriter*>> all();

  /// Publishes, or has a checkpoint or task wait for catch_up(), in place of an older one that does. Throws
  /// std::runtime_error where Fast DDS refuses.
  void send(const Message& message);
  /// Takes back what was said of this run, the Control apart, in catch_up(): when its last words must have been said
  /// and as soon as that may be. What is said of it after that is not sent.
  void withdraw(RunId run);
  /// Sends and withdraws what had to wait and no longer has to; whether anything was sent. To be called now and then.
  bool catch_up();

 private:
  using Time = std::chrono::steady_clock::time_point;
  /// A key's last value.
  struct Value {
    bool in_parts = false;  ///< whether it travels so
    Time written{};
  };
  using Values = std::map<TopicKey, Value>;

  bool hold(const TopicKey& key, const Message& message);
  void write(const TopicKey& key, const Message& message);
  bool have_arrived(Place place);
  bool may_replace(const TopicKey& key);
  std::optional<Time> end_of(RunId run) const;
  Values withdraw_arrived(Values ended);

  std::mutex mutex_;
  std::map<Place, Owned<eprosima::fastdds::dds::DataWriter>> writers_;
  Values published_;                         ///< those of runs that go on
  Values ended_;                             ///< those of runs that are over
  std::map<TopicKey, Message> held_;         ///< those that wait
  std::deque<std::pair<RunId, Time>> over_;  ///< the last ones that ended, and when
};

}  // namespace demecal
