// Data set files: what was measured, on which robot, in which columns.
#pragma once

#include <filesystem>

#include "data/data_set.hpp"

namespace demecal {

/// The poses and the robot of a DATASET.yaml; the files it names are taken relative to it. Where neither a set column
/// nor `split` divides the poses, 30 % of them validate, drawn with seed 1. Throws InputError with file, line, value
/// and rule at the first fault in any of the three files.
DataSet load_data_set(const std::filesystem::path& path);

}  // namespace demecal
