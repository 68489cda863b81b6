// What terminals show: a calibration as it goes on (a table of the islands that redraws itself, or plain lines where
// there is no terminal, and the rounds of the closed loop), and the pages of who watches.
#pragma once

#include <chrono>
#include <cstdint>
#include <cstdio>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "data/data_set.hpp"
#include "diagnosis/outcome.hpp"
#include "evolution/archipelago.hpp"
#include "fitness/parameters.hpp"
#include "monitor/watched.hpp"
#include "protocol/messages.hpp"
#include "scheduling/evolution_run.hpp"
#include "scheduling/run_state.hpp"
#include "workflows/workflows.hpp"

namespace demecal {

/// The islands of one run.
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
  const Breeds breeds_;
  std::map<IslandKey, Progress> last_;
  std::map<std::string, std::uint32_t> workers_;
  std::size_t drawn_lines_ = 0;
  bool changed_ = true;
  std::chrono::steady_clock::time_point last_plain_{};
};

/// The rounds of the closed loop, and what is done between them.
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

/// A calibration on standard error; nothing where `quiet`.
class ConsoleObserver final : public CalibrationObserver {
 public:
  explicit ConsoleObserver(bool quiet) : quiet_(quiet) {}

  void on_run_begins(const CalibrationData& data, const std::vector<Progress>& reached, bool shown) override;
  void on_run_ends(RunEnd end) override;
  void on_progress(const Progress& progress) override { run_->on_progress(progress); }
  void on_worker(const WorkerStatus& status) override { run_->on_worker(status); }
  void on_lost(const std::string& worker) override { run_->on_lost(worker); }
  void on_tick() override { run_->on_tick(); }
  void on_learning_begins(const Robot& described) override;
  void on_round(const Round& round, const Robot& /*described*/) override { loop_->on_round(round); }
  void on_message(const std::string& text) override { loop_->say(text); }
  void on_structure_generation(int generation, int generations, double left) override;

 private:
  bool quiet_;
  std::optional<ProgressDisplay> run_;
  std::optional<LoopDisplay> loop_;
};

class MonitorScreen {
 public:
  /// Colours where `out` is a terminal and NO_COLOR is not set; as wide as the terminal, elsewhere as COLUMNS says or
  /// 100.
  MonitorScreen(std::FILE* out, std::string place);
  /// Gives the terminal back, and leaves the last page on it.
  ~MonitorScreen();
  MonitorScreen(const MonitorScreen&) = delete;
  MonitorScreen& operator=(const MonitorScreen&) = delete;

  /// Draws where that is due: on a terminal some times a second when something has `changed`, and once a second as it
  /// is; elsewhere when something has changed, at most once a second.
  void offer(const Watched& watched, double now_s, bool changed);
  /// Draws what has changed since, due or not: nothing will follow.
  void settle(const Watched& watched, double now_s);
  /// Draws the whole page, as long as it takes, where the text stands.
  void print(const Watched& watched, double now_s);
  bool is_terminal() const { return terminal_; }
  /// That keys are read, of which the page then tells; and that one of them shows the legend of its columns, or hides
  /// it.
  void tell_of_keys() { keys_ = true; }
  void toggle_legend();

 private:
  using Clock = std::chrono::steady_clock;

  void draw(const Watched& watched, double now_s);
  void redraw(const Watched& watched, double now_s);

  std::FILE* out_;
  std::string place_;
  bool terminal_, colours_;
  bool keys_ = false, legend_ = false;
  bool in_place_ = false;  ///< the terminal's other screen is shown
  bool changed_ = true;
  Clock::time_point drawn_{};
  std::string last_;  ///< the page as it will stay
};

}  // namespace demecal
