// Whether bytes have the shape of a message, asked before anything is read from them: whoever reads first claims the
// memory that a count promises, and trusts that flags are flags.
#pragma once

#include <string_view>

#include "calibration.h"

namespace demecal {

enum class Endian { little, big };

/// More than any sample has that demecal sends.
inline constexpr std::size_t kMostSample_bytes = 64 << 20;

/// Whether `bytes` (CDR without encapsulation; idl/calibration.idl) are a `Wire` from beginning to end: no count
/// promises more than follows, flags are 0 or 1, codes of enumerations are known, texts are within their bound. Up to
/// three bytes that fill a word may follow. `Wire` is any message of the protocol.
template <class Wire>
bool has_shape(std::string_view bytes, Endian endian);

}  // namespace demecal
