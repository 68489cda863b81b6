#include "processor_time.hpp"

#include <sys/resource.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <string>

namespace demecal::bench {

std::map<pid_t, double> thread_seconds(pid_t process) {
  std::map<pid_t, double> seconds;
  std::error_code failure;
  const std::filesystem::path tasks = "/proc/" + std::to_string(process) + "/task";
  for (const auto& task : std::filesystem::directory_iterator(tasks, failure)) {
    double nanoseconds = 0.0;
    if (std::ifstream(task.path() / "schedstat") >> nanoseconds) {
      seconds[static_cast<pid_t>(std::stol(task.path().filename()))] = 1e-9 * nanoseconds;
    }
  }
  return seconds;
}

Split used_between(const std::map<pid_t, double>& before, const std::map<pid_t, double>& after) {
  Split split;
  for (const auto& [thread, seconds] : after) {
    const auto earlier = before.find(thread);
    const double used = seconds - (earlier == before.end() ? 0.0 : earlier->second);
    split.total_s += used;
    split.busiest_thread_s = std::max(split.busiest_thread_s, used);
  }
  return split;
}

double own_seconds() {
  rusage usage{};
  ::getrusage(RUSAGE_SELF, &usage);
  const auto seconds = [](const timeval& time) { return static_cast<double>(time.tv_sec) + 1e-6 * time.tv_usec; };
  return seconds(usage.ru_utime) + seconds(usage.ru_stime);
}

}  // namespace demecal::bench
