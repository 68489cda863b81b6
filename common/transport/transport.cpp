#include "transport/transport.hpp"

#include <unistd.h>

namespace demecal {

RunId Transport::new_run() {
  const auto moment = std::chrono::system_clock::now().time_since_epoch().count();
  return ((static_cast<RunId>(moment) << 16) ^ static_cast<RunId>(::getpid()) ^ 1U) & ~(RunId{1} << 63);
}

}  // namespace demecal
