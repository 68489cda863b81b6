// How long and how large a request may be.
#pragma once

#include <chrono>
#include <cstddef>

namespace demecal::inline http {

struct RequestBounds {
  std::chrono::milliseconds header_time{5000};  ///< from accepting a connection to the end of its header
  std::chrono::milliseconds rest_time{120000};  ///< for body and answer
  std::size_t header_bytes = 16384;
};

}  // namespace demecal::inline http
