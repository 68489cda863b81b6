// The worker processes a coordinator starts on its own machine, and stops when it is done.
#pragma once

#include <sys/types.h>

#include <string>
#include <vector>

namespace demecal {

class LocalWorkers {
 public:
  /// Starts `count` times the program `path` with `arguments`. They share the coordinator's standard error; they get no
  /// terminal signals (Ctrl-C is the coordinator's to handle) and are killed when the coordinator dies. Throws
  /// std::runtime_error where a process cannot be started.
  LocalWorkers(const std::string& path, const std::vector<std::string>& arguments, int count);
  /// Asks them to end, waits two seconds, and kills those that have not.
  ~LocalWorkers();
  LocalWorkers(const LocalWorkers&) = delete;
  LocalWorkers& operator=(const LocalWorkers&) = delete;

  /// Whether at least one is still running.
  bool any_alive();

 private:
  std::vector<pid_t> processes_;
};

/// The path of a program that stands beside the running one.
std::string beside_this_program(const std::string& name);

}  // namespace demecal
