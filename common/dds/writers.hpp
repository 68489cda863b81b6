// A participant's writers, and the places of what they have published about runs that go on.
#pragma once

#include <chrono>
#include <cstdint>
#include <deque>
#include <map>
#include <mutex>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "dds/participant.hpp"
#include "dds/parts.hpp"
#include "protocol/messages.hpp"

namespace demecal::inline dds {

/// Publishes what concerns a run in places (idl/calibration.idl), and vacates them when the run is over.
/// Any thread may call.
class DdsWriters {
 public:
  /// `name`: the participant's.
  explicit DdsWriters(std::string name) : name_(std::move(name)) {}

  /// A topic, and the joint (from 0) where it is migrants, else 0.
  using Channel = std::pair<Topic, std::uint32_t>;

  void add(Channel channel, Owned<eprosima::fastdds::dds::DataWriter> writer);
  /// The writer of a channel for which one was added.
  eprosima::fastdds::dds::DataWriter* at(Channel channel);
  std::vector<std::pair<Topic, eprosima::fastdds::dds::DataWriter*>> all();

  /// Publishes. Throws std::runtime_error where Fast DDS refuses.
  void send(const Message& message);
  /// Has vacate_ended() vacate the places of this run a while later, when its final messages have been published; what
  /// is sent about it after that is not.
  void withdraw(RunId run);
  /// Vacates the places of runs that ended long enough ago. To be called now and then.
  void vacate_ended();

 private:
  using Time = std::chrono::steady_clock::time_point;
  struct Writer {
    Owned<eprosima::fastdds::dds::DataWriter> dds;
    PlaceAllocator places;
    std::map<std::uint32_t, std::uint32_t> parts;  ///< of each place, those that were ever used
  };

  struct Ended {
    RunId run;
    Time at;
    bool vacated;
  };

  Writer& writer(Channel channel);
  bool is_drained(RunId run) const;
  void write_parts(Writer& writer, std::uint32_t place, std::string_view bytes);
  void vacate(Ended& ended);

  const std::string name_;
  std::mutex mutex_;
  std::map<Channel, Writer> writers_;
  std::uint64_t number_ = 0;  ///< of the last message in parts
  std::deque<Ended> over_;    ///< the last runs that ended
};

}  // namespace demecal::inline dds
