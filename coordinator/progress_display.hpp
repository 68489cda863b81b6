// Progress on the terminal while islands evolve: a table that redraws itself, or plain lines where there is no
// terminal.
#pragma once

#include <chrono>
#include <cstdio>
#include <map>
#include <string>

#include "coordinator/evolution_run.hpp"

namespace demecal {

class ProgressDisplay : public RunObserver {
 public:
  /// Writes to `out` (standard error, as a rule); redraws in place where that is a terminal.
  ProgressDisplay(std::FILE* out, const CalibrationData& data, bool quiet);

  void on_progress(const Progress& progress) override;
  void on_worker(const WorkerStatus& status) override;
  void on_lost(const std::string& worker) override;
  void on_tick() override;
  /// Draws the last state for good.
  void finish();

 private:
  std::string line(std::uint32_t joint) const;
  void redraw();
  void say(const std::string& text);

  std::FILE* out_;
  bool quiet_;
  bool terminal_;
  const GpParameters parameters_;
  const Archipelago archipelago_;
  std::map<IslandKey, Progress> last_;
  std::map<std::string, std::uint32_t> workers_;
  std::size_t drawn_lines_ = 0;
  bool changed_ = true;
  std::chrono::steady_clock::time_point last_plain_{};
};

}  // namespace demecal
