// A participant's writers, and what they have said of runs that go on.
#pragma once

#include <chrono>
#include <cstdint>
#include <deque>
#include <map>
#include <mutex>
#include <string_view>
#include <utility>
#include <vector>

#include "transport/dds_participant.hpp"
#include "transport/places.hpp"
#include "transport/topic.hpp"

namespace demecal {

/// Says what concerns a run in parts that have places (idl/calibration.idl), and vacates them when the run is over.
/// Any thread may call.
class DdsWriters {
 public:
  /// A topic, and the joint (from 0) where it is migrants, else 0.
  using Channel = std::pair<Topic, std::uint32_t>;

  void add(Channel channel, Owned<eprosima::fastdds::dds::DataWriter> writer);
  /// The writer of a channel for which one was added.
  eprosima::fastdds::dds::DataWriter* at(Channel channel);
  std::vector<std::pair<Topic, eprosima::fastdds::dds::DataWriter*>> all();

  /// Publishes. Throws std::runtime_error where Fast DDS refuses.
  void send(const Message& message);
  /// Has catch_up() vacate the places of this run a while later, when its last words have been said; what is said of it
  /// after that is not sent.
  void withdraw(RunId run);
  /// Vacates what had to wait and no longer has to. To be called now and then.
  void catch_up();

 private:
  using Time = std::chrono::steady_clock::time_point;
  struct Writer {
    Owned<eprosima::fastdds::dds::DataWriter> dds;
    Places places;
    std::map<std::uint32_t, std::uint32_t> parts;  ///< of each place, those that were ever used
  };

  struct Ended {
    RunId run;
    Time at;
    bool vacated;
  };

  Writer& writer(Channel channel);
  bool are_last_words_said(RunId run) const;
  void write_parts(Writer& writer, std::uint32_t place, std::string_view bytes);
  void vacate(Ended& ended);

  std::mutex mutex_;
  std::map<Channel, Writer> writers_;
  std::uint64_t number_ = 0;  ///< of the last message in parts
  std::deque<Ended> over_;    ///< the last runs that ended
};

}  // namespace demecal
