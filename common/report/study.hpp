// What a study found: calibrations for every cell of a grid of parameters and every seed, and what their formulas
// share.
#pragma once

#include <cstdint>
#include <limits>
#include <string>
#include <vector>

#include "evolution/building_blocks.hpp"

namespace demecal {

/// One calibration.
struct StudyRun {
  std::size_t cell = 0;  ///< from 0
  std::uint64_t seed = 0;
  double calibration_mm = std::numeric_limits<double>::quiet_NaN();  ///< rms; NaN where the set is empty, as below
  double validation_mm = std::numeric_limits<double>::quiet_NaN();
  double accept_mm = std::numeric_limits<double>::quiet_NaN();
  std::size_t nodes = 0;      ///< of the joints' corrections, with the factor that gives each its unit
  std::size_t corrected = 0;  ///< joints that got one
  std::uint64_t evaluations = 0;
  double wall_s = 0.0;
};

struct Study {
  std::string job, robot, data, data_sha256, version;
  bool closed_loop = false;
  std::vector<std::string> keys;                ///< parameters that were varied
  std::vector<std::vector<std::string>> cells;  ///< a value for each of them
  std::vector<std::uint64_t> seeds;
  std::vector<StudyRun> runs;         ///< as they were made: all cells with the first seed, and so on
  std::size_t islands = 0;            ///< whose fronts the blocks were looked for in
  std::vector<BuildingBlock> blocks;  ///< see building_blocks()
  bool interrupted = false;           ///< before all runs were made
};

/// A line for every cell, with medians over its seeds and how sure they are, in words below.
std::string study_table(const Study& study);

/// The first `most` blocks, a line each; a sentence where there are none.
std::string blocks_table(const Study& study, std::size_t most);

/// A row for every run.
std::string study_csv(const Study& study);

/// Everything: runs, medians and intervals of the cells, and all blocks.
std::string study_json(const Study& study, int indent = -1);

}  // namespace demecal
