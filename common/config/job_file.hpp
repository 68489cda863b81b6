// JOB.yaml: what the user asks for; and the grid of a study, whose cells are jobs.
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "calibration/job.hpp"
#include "fitness/parameters.hpp"
#include "parameters/declared_model.hpp"
#include "yaml/yaml_node.hpp"

namespace demecal::inline config {

/// The job of a JOB.yaml; its data set is named relative to it and not opened. What the file leaves out keeps the Job's
/// defaults. Throws InputError with file, line, value and rule at the first fault.
Job load_job(const std::filesystem::path& path);
/// The same of a file already read.
Job read_job(const YamlNode& root);

/// The kinds of effects, by the words of reports.
std::span<const std::string> effect_kinds();

/// The model that declares what `words` say, each of them one of declared_words().
DeclaredModel declared_model(std::span<const std::string> words);
/// The same of a list in a file. Throws InputError where a word is unknown or there twice.
DeclaredModel read_declared(const YamlNode& list);

/// The parameters of the map `gp`; those it leaves out keep their defaults. Throws InputError at the first fault, also
/// where together they break a rule of find_fault().
GpParameters read_gp(const YamlNode& node);

/// Reads from the same map `largest_correction_mrad`, `seed_formulas` (a text in rad for every joint, or {joint,
/// expression}) and `seed_models` (model files, whose corrections begin where they belong). Throws InputError at the
/// first fault.
CorrectionOptions read_correction_options(const YamlNode& node);

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
