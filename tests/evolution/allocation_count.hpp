// How often this test program has asked for memory.
#pragma once

#include <cstdint>

namespace demecal {

std::uint64_t allocation_count();

}  // namespace demecal
