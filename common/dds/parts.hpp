// Large messages in parts that fit into a datagram, messages put together again, and the places of both.
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "protocol/messages.hpp"
#include "transport/participants.hpp"

namespace demecal::inline dds {

/// What a datagram (64 KiB) holds beside the headers, signatures included.
inline constexpr std::size_t kPart_bytes = 60'000;

/// At least one part; `number` is the message's, above those of all before it.
std::vector<MessagePart> split_into_parts(std::string_view bytes, std::uint32_t place, std::uint64_t number);
/// What takes the place of a part when its message is withdrawn.
MessagePart vacant_part(std::uint32_t place, std::uint32_t index, std::uint64_t number);

/// Messages of which parts have come, of any number of writers. A writer's parts are to be handed over in the order in
/// which it wrote them.
class MessageAssembler {
 public:
  using Time = std::chrono::steady_clock::time_point;

  /// What is kept of one participant's unfinished messages stays below about so many bytes.
  explicit MessageAssembler(std::size_t most_bytes = 128 << 20) : most_bytes_(most_bytes) {}

  enum class Verdict { waits, whole, malformed, too_much };
  struct Result {
    Verdict verdict = Verdict::waits;
    std::string bytes;  ///< the message, where it is whole
  };
  /// A message is given up when a part of a newer one comes in its place; parts of older ones wait for nothing.
  Result take(const WriterId& writer, MessagePart part);
  /// The writer is gone, as far as the network knows. Its parts are not sent again when it comes back: unfinished
  /// messages are forgotten when their writer has been gone for kLongestAbsence.
  void departed(const WriterId& writer, Time now);

 private:
  using WriterPlace = std::pair<WriterId, std::uint32_t>;
  struct Unfinished {
    std::uint64_t message = 0;
    std::vector<std::optional<std::string>> parts;
    std::size_t missing = 0;
    std::size_t bytes = 0;
  };
  using UnfinishedMessages = std::map<WriterPlace, Unfinished>;

  Result add(const WriterPlace& place, MessagePart part);
  void forget(UnfinishedMessages::iterator unfinished);
  void forget_all_of(const WriterId& writer);

  std::size_t most_bytes_;
  UnfinishedMessages unfinished_;
  std::map<ParticipantId, std::size_t> bytes_;  ///< kept of each participant's
  std::map<WriterId, Time> gone_;               ///< since when
};

/// The places of one writer (idl/calibration.idl).
class PlaceAllocator {
 public:
  /// Where a message is published: the place of what it replaces, or the least that is free.
  std::uint32_t place_of(const Message& message);
  /// Frees the places of this run, and returns them.
  std::vector<std::uint32_t> vacate(RunId run);

 private:
  /// A value, and which of those that are kept of it.
  using Value = std::pair<TopicKey, std::uint32_t>;
  std::map<RunId, std::map<Value, std::uint32_t>> taken_;
  std::set<std::uint32_t> free_;
  std::uint32_t count_ = 0;
};

}  // namespace demecal::inline dds
