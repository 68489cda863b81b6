// The grid of a study: parameters of a job with the values that they take, and the job of every cell.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "calibration/job.hpp"
#include "yaml/yaml_node.hpp"

namespace demecal::inline config {

/// A parameter of jobs and its values, each of which knows where it was written.
struct GridAxis {
  std::string key;  ///< as in "gp.population_size", or "method"
  std::vector<YamlNode> values;
};

/// The axis that "KEY=VALUE,VALUE,..." writes, values as YAML writes them in a list: "gp.constants_range=[0,1],[0,2]".
/// Throws InputError, whose file is the option, where the key is none that a study varies or values are missing or
/// stand twice; so do the others here. What a value must be is checked when cells are made.
GridAxis read_axis(const std::string& option);

/// The axes of a GRID.yaml: the keys of a job with a list of values for each.
std::vector<GridAxis> load_grid(const std::filesystem::path& path);

/// One job of the grid.
struct GridCell {
  std::vector<std::string> values;  ///< one per axis, as they would be written
  Job job;
};

/// The cells of all combinations, the last axis turning fastest: the job of the file with each axis's value in place of
/// its own, read by the rules of every job. Without axes the job alone. Throws InputError where an axis stands twice,
/// there are more than 10000 cells, or a cell is no valid job: at the value at fault, with the cell named.
std::vector<GridCell> grid_cells(const std::filesystem::path& job_file, const std::vector<GridAxis>& axes);

}  // namespace demecal::inline config
