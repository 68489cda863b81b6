// Whether values can be in the unit their column claims: radians under _deg and metres under _mm betray themselves.
#pragma once

#include <map>
#include <span>
#include <string>

#include "data/column_map.hpp"
#include "data/column_unit.hpp"
#include "data/csv.hpp"
#include "data/pose.hpp"

namespace demecal {

/// Throws InputError where all angles headed degrees are as small as radians are and, read as radians, explain the
/// measured distances between poses better (without positions: spread as far as radians do); and where any angle headed
/// radians exceeds two turns and its joint's limits.
void check_joint_units(std::span<const MeasuredPose> poses, const ColumnMap& columns, const AssumedUnits& units,
                       const Chain& chain, const std::map<std::string, Eigen::Vector3d>& tools_m,
                       const CsvTable& table);

/// Throws InputError where the measured distances between poses are a thousand times those the nominal arm moved, or a
/// thousandth.
void check_position_units(std::span<const MeasuredPose> poses, const ColumnMap& columns, const AssumedUnits& units,
                          const Chain& chain, const std::map<std::string, Eigen::Vector3d>& tools_m,
                          const CsvTable& table);

}  // namespace demecal
