#include "dds/writers.hpp"

#include <algorithm>
#include <cstddef>
#include <memory>
#include <ranges>
#include <stdexcept>
#include <type_traits>
#include <utility>
#include <variant>

#include "dds/participant.hpp"
#include "dds/parts.hpp"
#include "errors/check.hpp"
#include "evolution/archipelago.hpp"
#include "protocol/message_bytes.hpp"

namespace demecal::inline dds {
namespace {

namespace fastdds = eprosima::fastdds::dds;

constexpr std::size_t kMostEndedRuns = 1024;
/// So long after a run's end its final messages may still be published.
constexpr std::chrono::milliseconds kFinalMessagesGrace{1000};

DdsWriters::Channel channel_of(const TopicKey& key) {
  return {key.topic, key.topic == Topic::migrants ? key.island.joint : 0};
}

template <class Plain>
void publish(fastdds::DataWriter& writer, Plain message) {
  Sample<Plain> sample(std::move(message));
  if (!writer.write(&sample)) throw std::runtime_error("DDS: cannot write to " + writer.get_topic()->get_name());
}

}  // namespace

void DdsWriters::add(Channel channel, Owned<fastdds::DataWriter> writer) {
  const std::lock_guard lock(mutex_);
  writers_[channel].dds = std::move(writer);
}

DdsWriters::Writer& DdsWriters::writer(Channel channel) {
  const auto found = writers_.find(channel);
  DEMECAL_CHECK(found != writers_.end(), "joint=" << channel.second << " is not offered");
  return found->second;
}

fastdds::DataWriter* DdsWriters::at(Channel channel) {
  const std::lock_guard lock(mutex_);
  return writer(channel).dds.get();
}

std::vector<std::pair<Topic, fastdds::DataWriter*>> DdsWriters::all() {
  const std::lock_guard lock(mutex_);
  std::vector<std::pair<Topic, fastdds::DataWriter*>> all;
  for (const auto& [channel, writer] : writers_) all.emplace_back(channel.first, writer.dds.get());
  return all;
}

bool DdsWriters::is_drained(RunId run) const {
  const auto found = std::ranges::find(over_, run, &Ended::run);
  return found != over_.end() && std::chrono::steady_clock::now() - found->at >= kFinalMessagesGrace;
}

void DdsWriters::send(const Message& message) {
  const std::lock_guard lock(mutex_);
  const TopicKey key = key_of(message);
  if (ends_with_run(key.topic) && is_drained(key.run)) return;
  Writer& own = writer(channel_of(key));
  std::visit(
      [&](const auto& plain) {
        using Plain = std::decay_t<decltype(plain)>;
        if constexpr (std::is_same_v<Plain, Progress>) {
          publish(*own.dds, PlacedProgress{name_, own.places.place_of(message), false, plain});
        } else if constexpr (kTravels<Plain>) {
          if (is_large(key.topic)) return write_parts(own, own.places.place_of(message), to_bytes(plain));
          publish(*own.dds, plain);
        }
      },
      message);
}

void DdsWriters::write_parts(Writer& own, std::uint32_t place, std::string_view bytes) {
  std::vector<MessagePart> parts = split_into_parts(bytes, place, ++number_);
  std::uint32_t& used = own.parts[place];
  used = std::max(used, static_cast<std::uint32_t>(parts.size()));
  for (MessagePart& part : parts) publish(*own.dds, std::move(part));
}

void DdsWriters::withdraw(RunId run) {
  const std::lock_guard lock(mutex_);
  if (std::ranges::find(over_, run, &Ended::run) != over_.end()) return;
  if (over_.size() == kMostEndedRuns) {
    vacate(over_.front());
    over_.pop_front();
  }
  over_.push_back({run, std::chrono::steady_clock::now(), false});
}

void DdsWriters::vacate(Ended& ended) {
  if (std::exchange(ended.vacated, true)) return;
  Progress nothing;
  nothing.run = ended.run;
  for (auto& [channel, own] : writers_)
    for (const std::uint32_t place : own.places.vacate(ended.run)) {
      if (channel.first == Topic::progress) publish(*own.dds, PlacedProgress{name_, place, true, nothing});
      for (std::uint32_t index = 0; index < own.parts[place]; ++index)
        publish(*own.dds, vacant_part(place, index, ++number_));
    }
}

void DdsWriters::vacate_ended() {
  const std::lock_guard lock(mutex_);
  const Time now = std::chrono::steady_clock::now();
  for (Ended& ended : over_)
    if (now - ended.at >= kFinalMessagesGrace) vacate(ended);
}

}  // namespace demecal::inline dds
