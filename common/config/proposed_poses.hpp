// Poses to be measured next, as a table in the form of the data set that they are to join.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "data/data_set.hpp"
#include "effects/arm_state.hpp"

namespace demecal {

/// The CSV of `stops`: their ids "N1" onwards, the commanded joints in the names and units of the columns of the data
/// set file, the side each joint is to be approached from, and the payload where one was recorded. Angles and lengths
/// are rounded to what a controller takes.
std::string proposed_poses_csv(const std::filesystem::path& data_set_file, const DataSet& data,
                               const std::vector<Stop>& stops);

}  // namespace demecal
