#include "transport/dds_writers.hpp"

#include <algorithm>
#include <stdexcept>
#include <utility>

#include "errors/check.hpp"
#include "transport/dds_qos.hpp"
#include "transport/message_bytes.hpp"
#include "transport/parts.hpp"
#include "transport/wire_form.hpp"

namespace demecal {
namespace {

namespace dds = eprosima::fastdds::dds;

constexpr std::size_t kMostOver = 64;
/// So long after a run's end its last words may still be said.
constexpr std::chrono::milliseconds kLastWords{1000};

DdsWriters::Channel channel_of(const TopicKey& key) {
  return {key.topic, key.topic == Topic::migrants ? key.island.joint : 0};
}

void publish(dds::DataWriter& writer, void* sample) {
  if (!writer.write(sample)) throw std::runtime_error("DDS: cannot write to " + writer.get_topic()->get_name());
}

/// Whether all that was said there has reached all who read it. To ask for one value alone would not do, since Fast DDS
/// forgets those who came late there.
bool have_arrived(dds::DataWriter& writer) {
  return writer.wait_for_acknowledgments({0, 0}) == ReturnCode_t::RETCODE_OK;
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

void DdsWriters::send(const Message& message) {
  const std::lock_guard lock(mutex_);
  const TopicKey key = key_of(message);
  if (ends_with_run(key.topic) && are_last_words_said(key.run)) return;
  held_.erase(key);
  if (must_wait(message)) {
    held_.emplace(key, message);
  } else {
    write(message);
  }
}

bool DdsWriters::are_last_words_said(RunId run) const {
  const auto found = std::ranges::find(over_, run, &Ended::run);
  return found != over_.end() && std::chrono::steady_clock::now() - found->at >= kLastWords;
}

/// Checkpoints that replaced each other before all their parts have arrived would arrive never.
bool DdsWriters::must_wait(const Message& message) {
  if (!std::holds_alternative<Checkpoint>(message)) return false;
  Writer& own = writer(channel_of(key_of(message)));
  return own.in_parts && !have_arrived(*own.dds);
}

void DdsWriters::write(const Message& message) {
  const TopicKey key = key_of(message);
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
  own.in_parts = parts.size() > 1;
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
  std::erase_if(held_, [run](const auto& held) { return held.first.run == run; });
}

void DdsWriters::vacate(Ended& ended) {
  if (std::exchange(ended.vacated, true)) return;
  std::erase_if(held_, [&](const auto& held) { return held.first.run == ended.run; });
  for (auto& [channel, own] : writers_)
    for (const std::uint32_t place : own.places.vacate(ended.run))
      for (std::uint32_t index = 0; index < own.parts[place]; ++index) {
        wire::Part nothing = vacant_part(place, index, ++number_);
        publish(*own.dds, &nothing);
      }
}

bool DdsWriters::catch_up() {
  const std::lock_guard lock(mutex_);
  const Time now = std::chrono::steady_clock::now();
  for (Ended& ended : over_)
    if (!ended.vacated && now - ended.at >= kLastWords) vacate(ended);
  const std::size_t sent = std::erase_if(held_, [this](const auto& held) {
    if (must_wait(held.second)) return false;
    write(held.second);
    return true;
  });
  return sent > 0;
}

}  // namespace demecal
