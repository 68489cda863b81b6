#include "recording/event_recording.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <nlohmann/json.hpp>
#include <optional>
#include <utility>
#include <variant>

#include "errors/input_error.hpp"
#include "monitor/state_json.hpp"
#include "recording/mcap.hpp"

namespace demecal::inline recording {
namespace {

constexpr double kChunk_s = 1.0;
constexpr std::size_t kMostChunkBytes = 256 * 1024;
constexpr std::size_t kMostChannels = 4096;

/// Where an event stands among the channels.
std::string topic_of(const nlohmann::ordered_json& event) {
  std::string topic = "/demecal/" + event["event"].get<std::string>();
  if (event.contains("island")) {
    topic += "/joint_" + std::to_string(event["joint"].get<std::uint32_t>()) + "/island_" +
             std::to_string(event["island"].get<std::uint32_t>());
  }
  return topic;
}

/// Without members that are null: their type would be another than the schema's.
void leave_out_nulls(nlohmann::ordered_json& event) {
  for (auto member = event.begin(); member != event.end();) {
    member = member->is_null() ? event.erase(member) : std::next(member);
  }
}

}  // namespace

EventRecording::EventRecording(std::uint64_t begin_ns)
    : begin_ns_(begin_ns), writer_(std::string("demecal ") + DEMECAL_VERSION) {
  for (const EventSchema& schema : event_schemas()) {
    schemas_[schema.word] = writer_.add_schema("demecal." + schema.word, schema.json);
  }
}

void EventRecording::take(const Message& message, double now_s) {
  nlohmann::ordered_json event = event_json(message, now_s);
  if (event.is_null()) return;
  leave_out_nulls(event);
  const std::uint16_t channel = channel_of(event["event"], topic_of(event));
  const auto time_ns = begin_ns_ + static_cast<std::uint64_t>(std::llround(1e9 * std::max(now_s, 0.0)));
  writer_.add_message(channel, time_ns, one_line(event));
}

std::uint16_t EventRecording::channel_of(const std::string& word, const std::string& topic) {
  const auto known = channels_.find(topic);
  if (known != channels_.end()) return known->second;
  // Of more islands than any run has, since somebody makes them up, the rest share one.
  if (channels_.size() >= kMostChannels && topic != "/demecal/" + word) return channel_of(word, "/demecal/" + word);
  return channels_[topic] = writer_.add_channel(schemas_.at(word), topic);
}

std::string EventRecording::due_bytes(double now_s) {
  if (now_s - chunk_began_s_ >= kChunk_s || writer_.chunk_bytes() >= kMostChunkBytes) {
    writer_.end_chunk();
    chunk_began_s_ = now_s;
  }
  return writer_.take_bytes();
}

std::string EventRecording::finish() {
  writer_.finish();
  return writer_.take_bytes();
}

namespace {

/// Nothing where the message is none of demecal's. Where what named its channel is damaged, its words tell.
std::optional<Event> event_of(const McapMessage& message, const std::string& file, int number) {
  if (!message.topic.empty())
    return message.topic.starts_with("/demecal/") ? read_event(message.data, file, number) : std::nullopt;
  try {
    return read_event(message.data, file, number);
  } catch (const InputError&) {
    return std::nullopt;
  }
}

/// `times_s` are those of all messages that were read.
std::string loss_sentence(const McapDamage& damage, const std::vector<double>& times_s) {
  const std::string bytes = damage.begin == damage.end
                                ? fmt::format("it was not written to its end (byte {})", damage.begin)
                                : fmt::format("bytes {} to {} are damaged", damage.begin, damage.end);
  if (!damage.hits_messages) return bytes + ", in indexes or the like: all that was seen is there";
  const double from_s = damage.messages_before == 0 ? 0.0 : times_s[damage.messages_before - 1];
  if (damage.messages_before == times_s.size())
    return fmt::format("{}: what was seen after {:.1f} s is missing", bytes, from_s);
  const double to_s = times_s[damage.messages_before];
  return fmt::format("{}: what was seen in {:.1f} s, from {:.1f} s to {:.1f} s, is missing", bytes, to_s - from_s,
                     from_s, to_s);
}

}  // namespace

RecordedEvents read_recording(std::string_view bytes, const std::string& file) {
  const McapContents contents = read_mcap(bytes, file);
  RecordedEvents recording;
  std::vector<double> times_s;
  for (const McapMessage& message : contents.messages) {
    auto event = event_of(message, file, static_cast<int>(times_s.size() + 1));
    times_s.push_back(event ? event->time_s : times_s.empty() ? 0.0 : times_s.back());
    if (event) recording.events.push_back(std::move(*event));
  }
  for (const McapDamage& damage : contents.damage) recording.losses.push_back(loss_sentence(damage, times_s));
  if (const std::uint64_t lost = contents.messages_lost.value_or(0); lost > 0)
    recording.losses.push_back(fmt::format("{} of {} events are missing", lost, lost + contents.messages.size()));
  return recording;
}

}  // namespace demecal::inline recording
