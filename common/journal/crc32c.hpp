// The checksum by which a record that was not written whole, or was changed since, is told from a sound one.
#pragma once

#include <cstdint>
#include <string_view>

namespace demecal {

/// CRC-32C (Castagnoli; RFC 3720, B.4) of the bytes.
std::uint32_t crc32c(std::string_view bytes);

}  // namespace demecal
