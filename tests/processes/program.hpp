// Starts the real programs, waits for them, and keeps what they said.
#pragma once

#include <sys/types.h>

#include <chrono>
#include <string>
#include <vector>

namespace demecal {

/// How a program ended: its exit code (128 + signal where a signal ended it) and what it wrote.
struct Ended {
  int code = -1;
  std::string out;
  std::string err;
};

/// A running program of the build under test; killed where it is still running when this goes.
class StartedProgram {
 public:
  /// `name` is a program of the build, such as "demecal", or the path of another. It sees the network that the process
  /// `network` sees; where that is 0, this one's.
  StartedProgram(const std::string& name, const std::vector<std::string>& arguments, pid_t network = 0);
  ~StartedProgram();
  StartedProgram(const StartedProgram&) = delete;
  StartedProgram& operator=(const StartedProgram&) = delete;

  pid_t process() const { return process_; }
  void signal(int number) const;
  /// Waits for the end; a test that waits longer than `patience` fails with code -1.
  Ended wait(std::chrono::seconds patience = std::chrono::seconds(120));
  /// Whether it ends within that time.
  bool ends_within(std::chrono::milliseconds patience);
  /// The processes it has started that run.
  std::vector<pid_t> children() const;
  /// What it wrote to standard output so far.
  std::string out_so_far() const;
  /// Waits until standard output holds `text`, or the program ended, or `patience` is over; whether it does.
  bool wait_for_out(const std::string& text, std::chrono::seconds patience = std::chrono::seconds(60));
  /// What it wrote to standard error so far.
  std::string err_so_far() const;
  /// Waits until standard error holds `text`, or the program ended, or `patience` is over; whether it does.
  bool wait_for_err(const std::string& text, std::chrono::seconds patience = std::chrono::seconds(60));

 private:
  bool has_ended();
  bool wait_for(const std::string& path, const std::string& text, std::chrono::seconds patience);

  std::string out_path_, err_path_;
  pid_t process_ = -1;
  bool ended_ = false;
  int status_ = 0;
};

/// Starts the program and waits for its end.
Ended run(const std::string& name, const std::vector<std::string>& arguments);

/// A DDS domain of this test process alone, as an option's value; another for each `which`.
std::string private_domain(int which = 0);

}  // namespace demecal
