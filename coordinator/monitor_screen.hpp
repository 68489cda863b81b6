// Where a watcher's pages appear: redrawn in place on a terminal, elsewhere one after the other.
#pragma once

#include <chrono>
#include <cstdio>
#include <string>

#include "monitor/watched.hpp"

namespace demecal {

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

 private:
  using Clock = std::chrono::steady_clock;

  void draw(const Watched& watched, double now_s);
  void redraw(const Watched& watched, double now_s);

  std::FILE* out_;
  std::string place_;
  bool terminal_, colours_;
  bool in_place_ = false;  ///< the terminal's other screen is shown
  bool changed_ = true;
  Clock::time_point drawn_{};
  std::string last_;  ///< the page as it will stay
};

}  // namespace demecal
