// A participant's writers, and what they have said of runs that go on.
#pragma once

#include <chrono>
#include <cstdint>
#include <deque>
#include <map>
#include <mutex>
#include <optional>
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

  /// Publishes; or has a checkpoint wait for catch_up(), in place of an older one that does, while one of several parts
  /// is on its way. Throws std::runtime_error where Fast DDS refuses.
  void send(const Message& message);
  /// Has catch_up() vacate the places of this run a while later, when its last words have been said; what is said of it
  /// after that is not sent.
  void withdraw(RunId run);
  /// Sends and vacates what had to wait and no longer has to; whether anything was sent. To be called now and then.
  bool catch_up();

 private:
  using Time = std::chrono::steady_clock::time_point;
  struct Writer {
    Owned<eprosima::fastdds::dds::DataWriter> dds;
    Places places;
    std::map<std::uint32_t, std::uint32_t> parts;  ///< of each place, those that were ever used
    bool in_parts = false;                         ///< whether its last message had several
  };

  struct Ended {
    RunId run;
    Time at;
    bool vacated;
  };

  Writer& writer(Channel channel);
  bool are_last_words_said(RunId run) const;
  bool must_wait(const Message& message);
  void write(const Message& message);
  void write_parts(Writer& writer, std::uint32_t place, std::string_view bytes);
  void vacate(Ended& ended);

  std::mutex mutex_;
  std::map<Channel, Writer> writers_;
  std::uint64_t number_ = 0;          ///< of the last message in parts
  std::map<TopicKey, Message> held_;  ///< those that wait
  std::deque<Ended> over_;            ///< the last runs that ended
};

}  // namespace demecal
