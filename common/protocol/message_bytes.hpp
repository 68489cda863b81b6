// Messages as bytes: as a file keeps them, and as a DDS sample holds them (idl/calibration.idl).
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

#include "protocol/messages.hpp"

namespace demecal::inline protocol {

// `Plain` is any message that travels, MessagePart or PlacedProgress.

/// CDR, little endian, without encapsulation. Numbers come back to the bit; text longer than its bound is cut off.
template <class Plain>
std::string to_bytes(const Plain& message);

/// The message, its texts made printable; nothing where the bytes are not one from beginning to end: a count promises
/// more than follows, a flag is neither true nor false, a code is unknown, a number lies below its first, a text or
/// sequence is longer than its bound, a formula's constant is not finite, or the run, the worker or the calibration is
/// none. No memory is claimed for what is not there. Whether the message makes sense in its run is not asked here, but
/// by protocol/faults.hpp.
template <class Plain>
std::optional<Plain> from_bytes(std::string_view bytes);

/// The message as a DDS sample: its bytes behind four that name their form.
template <class Plain>
std::string to_sample(const Plain& message);
/// The message of a sample, little endian or big; up to three bytes that fill a word may follow.
template <class Plain>
std::optional<Plain> from_sample(std::string_view bytes);

/// More than any sample has that demecal sends; what is larger is none.
inline constexpr std::size_t kMostSample_bytes = 64 << 20;

/// The key of a sample as DDS compares it: its key fields in CDR, big endian.
struct SampleKey {
  std::string bytes;
  bool is_long = false;  ///< whether a key of this kind may take more than 16 bytes, and is hashed
};
template <class Plain>
SampleKey key_bytes(const Plain& message);

/// About how much memory a message takes.
std::size_t weight_bytes(const Message& message);

/// `text` with a question mark for every control character, every character that turns the direction of writing, and
/// every byte that is not UTF-8.
std::string printable(std::string_view text);
bool is_printable(std::string_view text);

}  // namespace demecal::inline protocol
