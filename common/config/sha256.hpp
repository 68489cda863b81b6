// The hash by which results name the bytes they were made from.
#pragma once

#include <string>
#include <string_view>

namespace demecal {

/// SHA-256 (FIPS 180-4) of the bytes, 64 lower-case hexadecimal digits.
std::string sha256(std::string_view bytes);

}  // namespace demecal
