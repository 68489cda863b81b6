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
class Program {
 public:
  /// `name` is a program of the build, such as "demecal".
  Program(const std::string& name, const std::vector<std::string>& arguments);
  ~Program();
  Program(const Program&) = delete;
  Program& operator=(const Program&) = delete;

  pid_t process() const { return process_; }
  void signal(int number) const;
  /// Waits for the end; a test that waits longer than `patience` fails with code -1.
  Ended wait(std::chrono::seconds patience = std::chrono::seconds(120));
  /// What it wrote to standard error so far.
  std::string err_so_far() const;
  /// Waits until standard error holds `text`, or the program ended, or `patience` is over; whether it does.
  bool wait_for_err(const std::string& text, std::chrono::seconds patience = std::chrono::seconds(60));

 private:
  bool has_ended();

  std::string out_path_, err_path_;
  pid_t process_ = -1;
  bool ended_ = false;
  int status_ = 0;
};

/// Starts the program and waits for its end.
Ended run(const std::string& name, const std::vector<std::string>& arguments);

/// A DDS domain of this test process alone, as an option's value.
std::string private_domain();

}  // namespace demecal
