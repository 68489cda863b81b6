// Which rows are repeats of one pose, and where they stand.
#pragma once

#include <cstddef>
#include <vector>

#include "data/data_set.hpp"
#include "data/read_poses.hpp"

namespace demecal::inline data {

/// Rows at equal joints, in one set, are repeats of one pose where nothing names poses.
void name_repeats(std::vector<MeasuredPose>& poses);

/// The poses, each in the line that it has in that one of the tables.
std::vector<MeasuredPose> in_lines_of(std::size_t table, const JoinedTables& joined, std::vector<MeasuredPose> poses);

}  // namespace demecal::inline data
