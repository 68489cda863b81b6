// From a table of text to measured poses, checked against the robot they were measured on.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "data/column_map.hpp"
#include "data/column_unit.hpp"
#include "data/csv.hpp"
#include "data/pose.hpp"

namespace demecal {

/// One pose per row of the table, in its order, in SI units and radians. Where there is no pose column every row is a
/// pose of its own ("line 7"); where there is no set column all are for calibration. `tools_m` names the targets there
/// are. Throws InputError where a column is missing or named twice, its unit is unclear, a value is no number or breaks
/// its rule, or rows of one pose differ in joints or set. Whether the values are plausible is data_check's to say.
std::vector<MeasuredPose> read_poses(const CsvTable& table, const ColumnMap& columns, const AssumedUnits& units,
                                     const Chain& chain, const std::map<std::string, Eigen::Vector3d>& tools_m);

}  // namespace demecal
