// What a study found: calibrations for every cell of a grid of parameters and every seed, and what their formulas
// share.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "evolution/building_blocks.hpp"
#include "random/distributions.hpp"

namespace demecal::inline studies {

/// One calibration.
struct StudyRun {
  std::size_t cell = 0;  ///< from 0
  std::uint64_t seed = 0;
  std::optional<double> calibration_mm, validation_mm, accept_mm;  ///< rms; nothing where the set is empty
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

/// The figures of a cell over its seeds.
struct StudyCell {
  std::size_t runs = 0;
  /// Nothing where there is no run, or one without such poses.
  std::optional<MedianInterval> calibration_mm, validation_mm, accept_mm, nodes, evaluations, wall_s;
};

/// One for every cell, in their order.
std::vector<StudyCell> study_cells(const Study& study);

/// A row for every run.
std::string study_csv(const Study& study);

/// Everything: runs, medians and intervals of the cells, and all blocks.
std::string to_json(const Study& study, int indent = -1);

}  // namespace demecal::inline studies
