// Processor time of another process, thread by thread, as the kernel counts it.
#pragma once

#include <sys/types.h>

#include <map>

namespace demecal::bench {

/// Seconds that every thread of the process has run, by thread number; empty where there is no such process.
std::map<pid_t, double> thread_seconds(pid_t process);

struct Split {
  double total_s = 0.0;
  double busiest_thread_s = 0.0;
};
/// What was used between two readings.
Split used_between(const std::map<pid_t, double>& before, const std::map<pid_t, double>& after);

/// Of this process, s.
double own_seconds();

}  // namespace demecal::bench
