// From a table of text to measured poses, checked against the robot they were measured on.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <map>
#include <span>
#include <string>
#include <vector>

#include "data/columns.hpp"
#include "data/csv.hpp"
#include "data/data_set.hpp"
#include "kinematics/chain.hpp"

namespace demecal::inline data {

/// Angle for a revolute, length for a prismatic joint.
Quantity joint_quantity(const Joint& joint);

/// As many joint and approach columns as the arm has joints, three of position, four of orientation, no column twice,
/// and something measured.
void check_column_map(const ColumnMap& columns, const Chain& chain);

/// Every target named has its tool point.
void check_targets(std::span<const MeasuredPose> poses, const std::map<std::string, Eigen::Vector3d>& tools_m,
                   const std::string& file);

/// No joint stands further outside its limits than a controller's tolerance explains.
void check_joint_limits(std::span<const MeasuredPose> poses, const Chain& chain, const std::string& file);

/// Throws InputError at the first row that neither touches anything nor was measured otherwise; `contact` is the column
/// that says what rows touch.
void require_something_measured(std::span<const MeasuredPose> poses, const ColumnName& contact,
                                const std::string& file);
/// Poses of one id have equal joints and serve one set: otherwise validation would judge what calibration has seen.
/// `joined`: from several files. Measured points of one name then share a row of joints whatever was measured, so that
/// only their distance tells whether they are one pose.
void check_repeats(std::span<const MeasuredPose> poses, const std::string& file, bool joined = false);

/// Rows of several tables that belong together, one of each.
struct JoinedTables {
  std::vector<CsvTable> tables;                ///< one at least
  std::vector<std::vector<std::size_t>> rows;  ///< per pose: its row in each table
  std::size_t main = 0;                        ///< whose lines poses are named by
};

/// The table by itself.
JoinedTables alone(CsvTable table);

/// Whether `sigma` holds the uncertainty of an instrument's range and of its two angles; otherwise of coordinates.
bool states_range_and_angles(std::span<const CsvTable> tables, const ColumnMap& columns);

/// One pose per row of the tables, in its order, in SI units and radians. Where there is no pose column every row is a
/// pose of its own ("line 7"); where there is no set column all are for calibration. `tools_m` names the targets there
/// are. Throws InputError where a column is missing or named twice, its unit is unclear, a value is no number or breaks
/// its rule, or rows of one pose differ in joints or set. Whether the values are plausible is data_check's to say.
std::vector<MeasuredPose> read_poses(const JoinedTables& tables, const ColumnMap& columns, const AssumedUnits& units,
                                     const Chain& chain, const std::map<std::string, Eigen::Vector3d>& tools_m);
std::vector<MeasuredPose> read_poses(const CsvTable& table, const ColumnMap& columns, const AssumedUnits& units,
                                     const Chain& chain, const std::map<std::string, Eigen::Vector3d>& tools_m);

}  // namespace demecal::inline data
