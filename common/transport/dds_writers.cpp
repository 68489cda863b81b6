#include "transport/dds_writers.hpp"

#include <algorithm>
#include <stdexcept>
#include <utility>

#include "errors/check.hpp"
#include "transport/message_bytes.hpp"
#include "transport/parts.hpp"
#include "transport/wire_form.hpp"

namespace demecal {
namespace {

namespace dds = eprosima::fastdds::dds;

constexpr std::size_t kMostOver = 1024;
/// So long after a run's end its last words may still be said.
constexpr std::chrono::milliseconds kLastWords{1000};

DdsWriters::Channel channel_of(const TopicKey& key) {
  return {key.topic, key.topic == Topic::migrants ? key.island.joint : 0};
}

void publish(dds::DataWriter& writer, void* sample) {
  if (!writer.write(sample)) throw std::runtime_error("DDS: cannot write to " + writer.get_topic()->get_name());
}

}  // namespace

void DdsWriters::add(Channel channel, Owned<dds::DataWriter> writer) {
  const std::lock_guard lock(mutex_);
  writers_[channel].dds = std::move(writer);
}

DdsWriters::Writer& DdsWriters::writer(Channel channel) {
  const auto found = writers_.find(channel);
  DEMECAL_CHECK(found != writers_.end(), "joint=" << channel.second << " is not followed");
  return found->second;
}

dds::DataWriter* DdsWriters::at(Channel channel) {
  const std::lock_guard lock(mutex_);
  return writer(channel).dds.get();
}

std::vector<std::pair<Topic, dds::DataWriter*>> DdsWriters::all() {
  const std::lock_guard lock(mutex_);
  std::vector<std::pair<Topic, dds::DataWriter*>> all;
  for (const auto& [channel, writer] : writers_) all.emplace_back(channel.first, writer.dds.get());
  return all;
}

bool DdsWriters::are_last_words_said(RunId run) const {
  const auto found = std::ranges::find(over_, run, &Ended::run);
  return found != over_.end() && std::chrono::steady_clock::now() - found->at >= kLastWords;
}

void DdsWriters::send(const Message& message) {
  const std::lock_guard lock(mutex_);
  const TopicKey key = key_of(message);
  if (ends_with_run(key.topic) && are_last_words_said(key.run)) return;
  Writer& own = writer(channel_of(key));
  std::visit(
      [&](const auto& plain) {
        if constexpr (requires { encode(plain); }) {
          if (ends_with_run(key.topic)) return write_parts(own, own.places.place_of(message), to_bytes(plain));
          auto sample = encode(plain);
          publish(*own.dds, &sample);
        }
      },
      message);
}

void DdsWriters::write_parts(Writer& own, std::uint32_t place, std::string_view bytes) {
  std::vector<wire::Part> parts = parts_of(bytes, place, ++number_);
  std::uint32_t& used = own.parts[place];
  used = std::max(used, static_cast<std::uint32_t>(parts.size()));
  for (wire::Part& part : parts) publish(*own.dds, &part);
}

void DdsWriters::withdraw(RunId run) {
  const std::lock_guard lock(mutex_);
  if (std::ranges::find(over_, run, &Ended::run) != over_.end()) return;
  if (over_.size() == kMostOver) {
    vacate(over_.front());
    over_.pop_front();
  }
  over_.push_back({run, std::chrono::steady_clock::now(), false});
}

void DdsWriters::vacate(Ended& ended) {
  if (std::exchange(ended.vacated, true)) return;
  for (auto& [channel, own] : writers_)
    for (const std::uint32_t place : own.places.vacate(ended.run))
      for (std::uint32_t index = 0; index < own.parts[place]; ++index) {
        wire::Part nothing = vacant_part(place, index, ++number_);
        publish(*own.dds, &nothing);
      }
}

void DdsWriters::catch_up() {
  const std::lock_guard lock(mutex_);
  const Time now = std::chrono::steady_clock::now();
  for (Ended& ended : over_)
    if (now - ended.at >= kLastWords) vacate(ended);
}

}  // namespace demecal
