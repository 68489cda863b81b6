// What the closed loop is doing, round by round, on the terminal.
#pragma once

#include <chrono>
#include <cstdio>
#include <string>
#include <vector>

#include "data/data_set.hpp"
#include "diagnosis/outcome.hpp"

namespace demecal {

class LoopDisplay {
 public:
  /// Writes to `out` (standard error, as a rule): at once where that is a terminal, elsewhere only when the loop takes
  /// more than a second; nothing where `quiet`.
  LoopDisplay(std::FILE* out, const Robot& described, bool quiet);

  void on_round(const Round& round);
  void say(const std::string& text);

 private:
  std::FILE* out_;
  const Robot& described_;
  bool quiet_;
  bool terminal_;
  std::chrono::steady_clock::time_point begin_;
  std::vector<std::string> held_back_;
};

}  // namespace demecal
