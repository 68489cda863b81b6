#include "dds/parts.hpp"

#include <algorithm>
#include <array>
#include <variant>

#include "protocol/message_bytes.hpp"

namespace demecal::inline dds {
namespace {

constexpr std::size_t kMostParts = kMostSample_bytes / kPart_bytes + 1;
/// What an unfinished message takes beside its bytes.
constexpr std::size_t kUnfinished_bytes = 256;

std::string_view part_bytes(const MessagePart& part) {
  return {reinterpret_cast<const char*>(part.bytes.data()), part.bytes.size()};
}

/// Whether it can be a part of a message as split_into_parts() makes them.
bool is_sound(const MessagePart& part) {
  if (part.count > kMostParts || part.index >= part.count) return false;
  const bool is_last = part.index + 1 == part.count;
  return is_last ? part.bytes.size() <= kPart_bytes : part.bytes.size() == kPart_bytes;
}

/// Migrants of so many epochs are kept beside each other.
std::uint32_t turn_of(const Message& message) {
  const auto* migrants = std::get_if<Migrants>(&message);
  return migrants != nullptr ? migrants->epoch % static_cast<std::uint32_t>(values_kept(Topic::migrants)) : 0;
}

}  // namespace

std::vector<MessagePart> split_into_parts(std::string_view bytes, std::uint32_t place, std::uint64_t number) {
  const auto count =
      static_cast<std::uint32_t>(std::max<std::size_t>(1, (bytes.size() + kPart_bytes - 1) / kPart_bytes));
  std::vector<MessagePart> parts(count);
  for (std::uint32_t index = 0; index < count; ++index) {
    MessagePart& part = parts[index];
    const std::string_view own = bytes.substr(index * kPart_bytes, kPart_bytes);
    part.place = place;
    part.index = index;
    part.count = count;
    part.message = number;
    part.bytes.assign(own.begin(), own.end());
  }
  return parts;
}

MessagePart vacant_part(std::uint32_t place, std::uint32_t index, std::uint64_t number) {
  MessagePart part;
  part.place = place;
  part.index = index;
  part.message = number;
  return part;
}

MessageAssembler::Result MessageAssembler::take(const WriterId& writer, MessagePart part) {
  gone_.erase(writer);
  const WriterPlace place{writer, part.place};
  const auto known = unfinished_.find(place);
  if (known != unfinished_.end() && known->second.message < part.message) forget(known);
  if (part.count == 0) return {part.bytes.empty() && part.message > 0 ? Verdict::waits : Verdict::malformed, {}};
  if (!is_sound(part)) return {Verdict::malformed, {}};
  if (part.count == 1) return {Verdict::whole, std::string(part_bytes(part))};
  return add(place, std::move(part));
}

MessageAssembler::Result MessageAssembler::add(const WriterPlace& place, MessagePart part) {
  const auto [known, is_new] = unfinished_.try_emplace(place);
  Unfinished& message = known->second;
  std::size_t& kept = bytes_[participant_of(place.first)];
  if (is_new) {
    message = {part.message, {}, part.count, kUnfinished_bytes};
    message.parts.resize(part.count);
    message.bytes += part.count * sizeof message.parts.front();
    kept += message.bytes;
  }
  if (part.message < message.message) return {};
  if (part.count != message.parts.size()) return {Verdict::malformed, {}};
  if (message.parts[part.index]) return {};
  if (kept + part.bytes.size() > most_bytes_) {
    forget(known);
    return {Verdict::too_much, {}};
  }
  message.bytes += part.bytes.size();
  kept += part.bytes.size();
  message.parts[part.index] = std::string(part_bytes(part));
  if (--message.missing > 0) return {};
  Result whole{Verdict::whole, {}};
  for (const std::optional<std::string>& one : message.parts) whole.bytes += *one;
  forget(known);
  return whole;
}

void MessageAssembler::forget(UnfinishedMessages::iterator unfinished) {
  const auto kept = bytes_.find(participant_of(unfinished->first.first));
  kept->second -= unfinished->second.bytes;
  if (kept->second == 0) bytes_.erase(kept);
  unfinished_.erase(unfinished);
}

void MessageAssembler::departed(const WriterId& writer, Time now) {
  gone_[writer] = now;
  std::erase_if(gone_, [&](const auto& gone) {
    if (now - gone.second < kLongestAbsence) return false;
    forget_all_of(gone.first);
    return true;
  });
}

void MessageAssembler::forget_all_of(const WriterId& writer) {
  while (true) {
    const auto first = unfinished_.lower_bound({writer, 0});
    if (first == unfinished_.end() || first->first.first != writer) return;
    forget(first);
  }
}

std::uint32_t PlaceAllocator::place_of(const Message& message) {
  const TopicKey key = key_of(message);
  auto& of_run = taken_[key.run];
  const auto [known, is_new] = of_run.try_emplace({key, turn_of(message)}, count_);
  if (!is_new) return known->second;
  if (free_.empty()) return count_++;
  known->second = *free_.begin();
  free_.erase(free_.begin());
  return known->second;
}

std::vector<std::uint32_t> PlaceAllocator::vacate(RunId run) {
  std::vector<std::uint32_t> places;
  const auto of_run = taken_.find(run);
  if (of_run == taken_.end()) return places;
  for (const auto& [value, place] : of_run->second) places.push_back(place);
  taken_.erase(of_run);
  free_.insert(places.begin(), places.end());
  return places;
}

}  // namespace demecal::inline dds
