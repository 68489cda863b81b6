// Processor time of the calling thread: what others do on the machine counts less than on a wall clock.
#pragma once

#include <ctime>

namespace demecal::bench::engine {

inline double thread_seconds() {
  timespec time{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
  return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

}  // namespace demecal::bench::engine
