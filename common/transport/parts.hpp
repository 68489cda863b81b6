// Messages of any size in parts that each fit into a datagram, and messages put together of parts again.
#pragma once

#include <chrono>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "calibration.h"
#include "transport/presence.hpp"

namespace demecal {

/// What a datagram (64 KiB) holds beside the headers, signatures included.
inline constexpr std::size_t kPart_bytes = 60'000;

/// At least one part; `number` is the message's, above those of all before it.
std::vector<wire::Part> parts_of(std::string_view bytes, std::uint32_t place, std::uint64_t number);
/// What takes the place of a part when nothing is said there any more.
wire::Part vacant_part(std::uint32_t place, std::uint32_t index, std::uint64_t number);

/// Messages of which parts have come, of any number of writers. A writer's parts are to be handed over in the order in
/// which it wrote them.
class Assembly {
 public:
  using Time = std::chrono::steady_clock::time_point;

  /// What is kept of one participant's unfinished messages stays below about so many bytes.
  explicit Assembly(std::size_t most_bytes = 128 << 20) : most_bytes_(most_bytes) {}

  enum class Verdict { waits, whole, malformed, too_much };
  struct Result {
    Verdict verdict = Verdict::waits;
    std::string bytes;  ///< the message, where it is whole
  };
  /// A message is given up when a part of a newer one comes in its place; parts of older ones wait for nothing.
  Result take(const WriterId& writer, wire::Part part);
  /// The writer is gone, as far as the network tells. What it said is not said again when it comes back: forgotten is
  /// what those did not finish who have been gone for kLongestAbsence.
  void departed(const WriterId& writer, Time now);

 private:
  using Place = std::pair<WriterId, std::uint32_t>;
  struct Unfinished {
    std::uint64_t message = 0;
    std::vector<std::optional<std::string>> parts;
    std::size_t missing = 0;
    std::size_t bytes = 0;
  };
  using Places = std::map<Place, Unfinished>;

  Result add(const Place& place, wire::Part part);
  void forget(Places::iterator unfinished);
  void forget_all_of(const WriterId& writer);

  std::size_t most_bytes_;
  Places unfinished_;
  std::map<ParticipantId, std::size_t> bytes_;  ///< kept of each participant's
  std::map<WriterId, Time> gone_;               ///< since when
};

}  // namespace demecal
