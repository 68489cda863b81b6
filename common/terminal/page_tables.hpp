// The tables under the islands on a watcher's page: workers, rounds of the closed loop, what happened last.
#pragma once

#include <string>
#include <vector>

#include "monitor/watched.hpp"

namespace demecal {

struct TableOptions {
  std::size_t columns = 100;
  std::size_t rows = 0;  ///< at most, the last ones; 0: all
  bool colours = false;
};

/// Each of these: lines without ends, a heading first, none wider than the columns; no line where there is nothing.
std::vector<std::string> worker_lines(const Watched& watched, double now_s, const TableOptions& options);
/// `calibration` may be null.
std::vector<std::string> round_lines(const WatchedCalibration* calibration, const TableOptions& options);
std::vector<std::string> happening_lines(const Watched& watched, double now_s, const TableOptions& options);

}  // namespace demecal
