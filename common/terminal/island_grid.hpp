// The islands of a run as a grid of text: a row for each joint, its demes side by side where they fit.
#pragma once

#include <string>
#include <vector>

#include "monitor/watched.hpp"

namespace demecal::inline terminal {

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
