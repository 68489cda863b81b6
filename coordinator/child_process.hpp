// A program that runs in a folder, with what it says going to a file.
#pragma once

#include <sys/types.h>
#include <optional>
#include <string>
#include <vector>

namespace demecal {

class ChildProcess {
 public:
  /// Starts `path` with `arguments` in `folder`; standard output and error go to the descriptor `said`. It is
  /// interrupted when this thread dies. Throws std::runtime_error where it cannot be started.
  ChildProcess(const std::string& path, const std::vector<std::string>& arguments, const std::string& folder, int said);
  /// Kills it, and all that it started, where it still runs.
  ~ChildProcess();
  ChildProcess(const ChildProcess&) = delete;
  ChildProcess& operator=(const ChildProcess&) = delete;

  /// SIGINT, once.
  void interrupt();
  /// Its exit code, or 128 and the signal that ended it; nothing while it runs.
  std::optional<int> exit_code();

 private:
  pid_t process_ = -1;
  bool is_interrupted_ = false;
  std::optional<int> exit_code_;
};

}  // namespace demecal
