#include "data/read_poses.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <utility>

#include "data/columns.hpp"
#include "data/payload.hpp"
#include "data/repeated_names.hpp"
#include "data/text.hpp"
#include "errors/input_error.hpp"
#include "kinematics/units.hpp"

namespace demecal::inline data {
namespace {

using TableColumns = std::vector<TableColumn>;

/// The columns of a data set, found in its tables.
struct FoundColumns : PoseColumns<TableColumn> {
  bool sigma_by_angles = false;
};

using Tables = std::vector<CsvTable>;

TableColumns find_all(const Tables& tables, const std::vector<ColumnName>& names) {
  TableColumns columns;
  for (const ColumnName& name : names) columns.emplace_back(tables[name.table], name);
  return columns;
}

TableColumns find_all(const Tables& tables, const std::vector<ColumnName>& names, Quantity quantity,
                      const AssumedUnits& units) {
  TableColumns columns;
  for (const ColumnName& name : names) columns.emplace_back(tables[name.table], name, quantity, units);
  return columns;
}

/// One column a joint, of the quantity that `quantity_of` gives for it.
TableColumns find_by_joint(const Tables& tables, const std::vector<ColumnName>& names, const AssumedUnits& units,
                           const Chain& chain, Quantity quantity_of(const Joint&)) {
  TableColumns columns;
  for (std::size_t i = 0; i < names.size(); ++i) {
    columns.emplace_back(tables[names[i].table], names[i], quantity_of(chain.joints[i]), units);
  }
  return columns;
}

Quantity load_quantity(const Joint& joint) {
  return is_revolute(joint) ? Quantity::torque : Quantity::force;
}

template <typename... Rest>
std::optional<TableColumn> find_one(const Tables& tables, const std::optional<ColumnName>& name, const Rest&... rest) {
  if (!name) return std::nullopt;
  return TableColumn(tables[name->table], *name, rest...);
}

TableColumns find_sigma(const Tables& tables, const ColumnMap& map, const AssumedUnits& units, bool by_angles) {
  TableColumns columns;
  for (const ColumnName& name : map.sigma)
    columns.emplace_back(tables[name.table], name, by_angles && !columns.empty() ? Quantity::angle : Quantity::length,
                         units);
  return columns;
}

FoundColumns find_columns(const Tables& tables, const ColumnMap& map, const AssumedUnits& units, const Chain& chain) {
  FoundColumns found;
  found.joints = find_by_joint(tables, map.joints, units, chain, joint_quantity);
  found.position = find_all(tables, map.position, Quantity::length, units);
  found.orientation = find_all(tables, map.orientation);
  found.sigma_by_angles = states_range_and_angles(tables, map);
  found.sigma = find_sigma(tables, map, units, found.sigma_by_angles);
  found.distances = find_all(tables, map.distances, Quantity::length, units);
  found.approach = find_all(tables, map.approach);
  found.torque = find_by_joint(tables, map.torque, units, chain, load_quantity);
  found.payload = find_one(tables, map.payload, Quantity::mass, units);
  found.temperature = find_one(tables, map.temperature, Quantity::temperature, units);
  found.time = find_one(tables, map.time, Quantity::time, units);
  found.set = find_one(tables, map.set);
  found.pose = find_one(tables, map.pose);
  found.target = find_one(tables, map.target);
  found.contact = find_one(tables, map.contact);
  return found;
}

/// The rows of one pose, by table.
class PoseRows {
 public:
  PoseRows(const JoinedTables& joined, std::size_t pose) : joined_(joined), pose_(pose) {}

  const CsvRow& of_table(std::size_t table) const { return joined_.tables[table].rows[joined_.rows[pose_][table]]; }
  const CsvRow& of(const TableColumn& column) const { return of_table(column.table()); }
  std::size_t line() const { return of_table(joined_.main).line; }

  double number(const TableColumn& column) const { return column.number(of(column)); }
  const std::string& text(const TableColumn& column) const { return column.text(of(column)); }
  [[noreturn]] void fail(const TableColumn& column, const std::string& rule) const { column.fail(of(column), rule); }

 private:
  const JoinedTables& joined_;
  std::size_t pose_;
};

template <typename Vector>
Vector read_vector(const TableColumns& columns, const PoseRows& rows) {
  Vector values(static_cast<Eigen::Index>(columns.size()));
  for (std::size_t i = 0; i < columns.size(); ++i) values[static_cast<Eigen::Index>(i)] = rows.number(columns[i]);
  return values;
}

Eigen::Quaterniond read_orientation(const TableColumns& columns, const PoseRows& rows) {
  constexpr double kNormTolerance = 1e-3;  // rounded decimals stay within it; Euler angles and swapped columns do not
  const Eigen::Vector4d wxyz = read_vector<Eigen::Vector4d>(columns, rows);
  if (!(std::abs(wxyz.norm() - 1.0) <= kNormTolerance)) {
    rows.fail(columns.front(), "and its three neighbours have norm " + number_text(wxyz.norm()) +
                                   "; an orientation must be a unit quaternion w, x, y, z");
  }
  return Eigen::Quaterniond(wxyz[0], wxyz[1], wxyz[2], wxyz[3]).normalized();
}

/// The axes along which an instrument at the origin measures a point: its range, and across to the side and upwards.
Eigen::Matrix3d instrument_axes(const Eigen::Vector3d& point_m) {
  Eigen::Matrix3d axes;
  axes.col(0) = point_m.normalized();
  axes.col(1) = Eigen::Vector3d::UnitZ().cross(point_m).stableNormalized();
  if (axes.col(1).isZero(0.0)) axes.col(1) = Eigen::Vector3d::UnitX();
  axes.col(2) = axes.col(0).cross(axes.col(1));
  return axes;
}

/// Columns of sigma: one for all axes, x, y, z, or range and the angles about the vertical and of elevation.
Eigen::Matrix3d read_covariance(const FoundColumns& columns, const PoseRows& rows, const Eigen::Vector3d& position_m) {
  constexpr double kLeast_m = 1e-9;  ///< beside the pole an angle about it says everything
  Eigen::Vector3d sigma;
  for (Eigen::Index axis = 0; axis < 3; ++axis) {
    const TableColumn& column = columns.sigma[columns.sigma.size() == 1 ? 0 : static_cast<std::size_t>(axis)];
    sigma[axis] = rows.number(column);
    if (!(sigma[axis] > 0.0)) rows.fail(column, "must be above 0: it is a standard uncertainty");
  }
  if (!columns.sigma_by_angles) return sigma.cwiseAbs2().asDiagonal();
  if (!(position_m.norm() > kLeast_m))
    rows.fail(columns.sigma[0], "is of a point at the instrument itself, which has no direction");
  sigma[1] *= position_m.head<2>().norm();
  sigma[2] *= position_m.norm();
  const Eigen::Matrix3d axes = instrument_axes(position_m);
  return axes * sigma.cwiseMax(kLeast_m).cwiseAbs2().asDiagonal() * axes.transpose();
}

ApproachSigns read_approach(const TableColumns& columns, const PoseRows& rows) {
  const auto signs = read_vector<ApproachSigns>(columns, rows);
  for (Eigen::Index i = 0; i < signs.size(); ++i) {
    if (signs[i] == -1.0 || signs[i] == 0.0 || signs[i] == 1.0) continue;
    rows.fail(columns[static_cast<std::size_t>(i)], "must be -1, 0 or 1: the sign of the joint's last motion");
  }
  return signs;
}

std::vector<double> read_distances(const TableColumns& columns, const PoseRows& rows) {
  std::vector<double> distances;
  for (const TableColumn& column : columns) {
    distances.push_back(rows.number(column));
    if (distances.back() <= 0.0) rows.fail(column, "must be positive: it is a measured length");
  }
  return distances;
}

double read_payload(const TableColumn& column, const PoseRows& rows) {
  const double payload_kg = rows.number(column);
  if (payload_kg < 0.0) rows.fail(column, "must not be negative: it is a mass");
  if (payload_kg > 1e5) rows.fail(column, "is more than any robot carries (100 t): is it in kg?");
  if (payload_kg > kMostPayload_kg && !column.unit_is_stated())
    rows.fail(column,
              "is above 2300 kg, more than robots carry, and the heading states no unit: end the name in _g, or in _kg "
              "if it is right");
  return payload_kg;
}

double read_temperature(const TableColumn& column, const PoseRows& rows) {
  constexpr double kLowest_celsius = -273.15, kHighest_celsius = 1000.0, kHighestUnstated_celsius = 60.0;
  const double celsius = rows.number(column);
  if (celsius < kLowest_celsius || celsius > kHighest_celsius)
    rows.fail(column, "is no temperature of an arm: is it in deg C?");
  if (celsius > kHighestUnstated_celsius && !column.unit_is_stated())
    rows.fail(
        column,
        "is above 60 deg C, warmer than arms are, and the heading states no unit: end the name in _f or _k, or in "
        "_celsius if it is right");
  return celsius;
}

Eigen::Vector3d read_position(const TableColumns& columns, const PoseRows& rows) {
  constexpr double kFarthest_m = 1e5;
  const auto position_m = read_vector<Eigen::Vector3d>(columns, rows);
  for (Eigen::Index axis = 0; axis < 3; ++axis) {
    if (std::abs(position_m[axis]) > kFarthest_m)
      rows.fail(columns[static_cast<std::size_t>(axis)],
                "is farther than any instrument measures (100 km): correct it, or leave the row out");
  }
  return position_m;
}

PoseSet read_pose_set(const TableColumn& column, const PoseRows& rows) {
  if (rows.text(column) == "calibration") return PoseSet::calibration;
  if (rows.text(column) == "validation") return PoseSet::validation;
  if (rows.text(column) == "accept") return PoseSet::accept;
  rows.fail(column, "must be calibration, validation or accept");
}

std::string read_pose_id(const TableColumn& column, const PoseRows& rows) {
  if (rows.text(column).empty()) rows.fail(column, "is empty where the name of a pose is expected");
  return rows.text(column);
}

bool all_empty(const TableColumns& columns, const PoseRows& rows) {
  return std::ranges::all_of(columns, [&rows](const TableColumn& column) { return rows.text(column).empty(); });
}

/// What an instrument gave. A row that touches something may have been measured by nothing else.
void read_measured(const FoundColumns& columns, const PoseRows& rows, MeasuredPose& pose) {
  const auto given = [&](const TableColumns& some) {
    return !some.empty() && (pose.contact.empty() || !all_empty(some, rows));
  };
  if (given(columns.position)) pose.position_m = read_position(columns.position, rows);
  if (pose.position_m && !columns.sigma.empty())
    pose.position_covariance_m2 = read_covariance(columns, rows, *pose.position_m);
  if (given(columns.orientation)) pose.orientation = read_orientation(columns.orientation, rows);
  if (given(columns.distances)) pose.distances_m = read_distances(columns.distances, rows);
}

MeasuredPose read_pose(const FoundColumns& columns, const PoseRows& rows) {
  MeasuredPose pose;
  pose.line = rows.line();
  pose.joints = read_vector<JointVector>(columns.joints, rows);
  if (columns.contact) pose.contact = rows.text(*columns.contact);
  read_measured(columns, rows, pose);
  if (!columns.approach.empty()) pose.approach = read_approach(columns.approach, rows);
  if (!columns.torque.empty()) pose.torque = read_vector<JointVector>(columns.torque, rows);
  if (columns.payload) pose.payload_kg = read_payload(*columns.payload, rows);
  if (columns.temperature) pose.temperature_celsius = read_temperature(*columns.temperature, rows);
  if (columns.time) pose.time_s = rows.number(*columns.time);
  if (columns.set) pose.set = read_pose_set(*columns.set, rows);
  pose.pose_id = columns.pose ? read_pose_id(*columns.pose, rows) : line_name(rows.line());
  if (columns.target) pose.target = rows.text(*columns.target);
  return pose;
}

}  // namespace

Quantity joint_quantity(const Joint& joint) {
  return is_revolute(joint) ? Quantity::angle : Quantity::length;
}

JoinedTables alone(CsvTable table) {
  JoinedTables joined;
  for (std::size_t row = 0; row < table.rows.size(); ++row) joined.rows.push_back({row});
  joined.tables.push_back(std::move(table));
  return joined;
}

bool states_range_and_angles(std::span<const CsvTable> tables, const ColumnMap& columns) {
  return columns.sigma.size() == 3 &&
         angle_or_length(tables[columns.sigma[1].table], columns.sigma[1]) == Quantity::angle;
}

std::vector<MeasuredPose> read_poses(const JoinedTables& joined, const ColumnMap& columns, const AssumedUnits& units,
                                     const Chain& chain, const std::map<std::string, Eigen::Vector3d>& tools_m) {
  check_column_map(columns, chain);
  const FoundColumns found = find_columns(joined.tables, columns, units, chain);
  std::vector<MeasuredPose> poses;
  poses.reserve(joined.rows.size());
  for (std::size_t pose = 0; pose < joined.rows.size(); ++pose) poses.push_back(read_pose(found, {joined, pose}));
  if (!columns.pose) name_repeats(poses);
  check_targets(poses, tools_m, joined.tables[joined.main].file);
  if (columns.contact) require_something_measured(poses, *columns.contact, joined.tables[joined.main].file);
  if (joined.tables.size() == 1 || columns.position.empty()) {
    check_repeats(poses, joined.tables[joined.main].file);
  } else {
    const std::size_t measured = columns.position.front().table;
    check_repeats(in_lines_of(measured, joined, poses), joined.tables[measured].file, true);
  }
  return poses;
}

std::vector<MeasuredPose> read_poses(const CsvTable& table, const ColumnMap& columns, const AssumedUnits& units,
                                     const Chain& chain, const std::map<std::string, Eigen::Vector3d>& tools_m) {
  return read_poses(alone(table), columns, units, chain, tools_m);
}

}  // namespace demecal::inline data
