// Messages as bytes that a file can keep, in the form in which they travel (idl/calibration.idl, little endian).
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "protocol/messages.hpp"

namespace demecal {

/// `Plain` is any message that travels. Numbers come back to the bit; text longer than its bound is cut off.
template <class Plain>
std::string to_bytes(const Plain& message);

/// The message, or nothing where the bytes are not one. Whether it makes sense in its run is not asked here, but by
/// protocol/faults.hpp.
template <class Plain>
std::optional<Plain> message_of(std::string_view bytes);

}  // namespace demecal
