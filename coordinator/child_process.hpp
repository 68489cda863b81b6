// A program that runs in a folder, with what it says going to a file; programs that happen to be installed, run
// unheard; and pages as PDF by one of them: weasyprint or a browser without a window.
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
  /// Its exit code, or 128 and the signal that ended it; nothing while it runs. 127, as of a program that cannot be
  /// started, where the system no longer knows how it ended.
  std::optional<int> exit_code();

 private:
  pid_t process_ = -1;
  bool is_interrupted_ = false;
  std::optional<int> exit_code_;
};

/// A folder of its own under the temporary one, its owner's alone; removed with all that was left in it.
class ScratchFolder {
 public:
  ScratchFolder();
  ~ScratchFolder();
  ScratchFolder(const ScratchFolder&) = delete;
  ScratchFolder& operator=(const ScratchFolder&) = delete;

  /// Empty where it could not be made.
  const std::string& path() const { return path_; }

 private:
  std::string path_;
};

/// The path of the first of these programs that is in PATH; nothing where there is none.
std::optional<std::string> find_program(const std::vector<std::string>& names);

/// Runs the program, its path first, in a group of its own, unheard; whether it ended well within a minute.
bool runs_well(std::vector<std::string> words);

/// The path of a program of PATH that can print pages; nothing where there is none.
std::optional<std::string> find_printer();

/// What the printer makes of the page of that file; nothing where it fails or takes longer than a minute.
std::optional<std::string> printed(const std::string& printer, const std::string& page_file);

}  // namespace demecal
