// All that a watcher has seen as one page of text for a terminal, and its islands as a grid.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "monitor/watched.hpp"

namespace demecal::inline terminal {
struct PageOptions {
  std::size_t columns = 100;  ///< of the terminal; fewer than 40 count as 40
  std::size_t lines = 0;      ///< to stay within, where that can be; 0: as many as it takes
  bool colours = false;
  double now_s = 0.0;   ///< in the time of what was taken
  std::string place;    ///< where one watches: "domain 3"
  bool legend = false;  ///< with what the columns of the islands mean
  bool keys = false;    ///< the last line says what the keys do
};

/// The page's lines, without ends, none wider than `columns`: the calibration and how long its evolution still takes,
/// the islands, the workers, what the closed loop found, and what happened last. One sentence where nothing was seen.
/// Where the lines are not limited, texts are wrapped; elsewhere they are cut, so that all rows have room.
std::vector<std::string> monitor_page(const Watched& watched, const PageOptions& options);

struct TableOptions {
  std::size_t columns = 100;
  std::size_t rows = 0;  ///< at most, the last ones; 0: all
  bool colours = false;
  bool wraps = false;  ///< texts go on in further lines instead of being cut
};

/// Each of these: lines without ends, a heading first, none wider than the columns; no line where there is nothing.
std::vector<std::string> worker_lines(const Watched& watched, double now_s, const TableOptions& options);
/// `calibration` may be null.
std::vector<std::string> round_lines(const WatchedCalibration* calibration, const TableOptions& options);
/// The same; of more rows the first, which are the costliest.
std::vector<std::string> cause_lines(const WatchedCalibration* calibration, const TableOptions& options);
std::vector<std::string> event_lines(const Watched& watched, double now_s, const TableOptions& options);
/// What the columns of islands and workers mean, wrapped; of the columns of `island_grid` all, shown or not.
std::vector<std::string> column_legend(std::size_t columns, bool colours);
/// The bar of the shown evolution and its share over the whole width, after a full bar for each evolution that the
/// calibration has done before; empty where no run was seen.
std::string progress_bar(const Watched& watched, std::size_t columns, bool colours);

struct GridOptions {
  std::size_t columns = 100;  ///< of the terminal; at least 40
  std::size_t lines = 0;      ///< to stay within, where that can be; 0: as many as it takes
  bool colours = false;
};

/// Lines without ends, a heading first, none wider than `columns`. Every island shows as many of its figures as there
/// is room for: generation, best and median fitness, diversity, evaluations/s, migrants sent and taken, share of
/// waiting, and its worker as the place in `workers`, from 1: "w1". Where even the least does not fit, the last line
/// says how many islands are left out.
std::vector<std::string> island_grid(const WatchedRun& run, const std::vector<const WatchedWorker*>& workers,
                                     const GridOptions& options);

}  // namespace demecal::inline terminal
