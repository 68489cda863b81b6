#include "data/read_poses.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <optional>
#include <set>
#include <utility>

#include "data/columns.hpp"
#include "data/text.hpp"
#include "errors/input_error.hpp"
#include "kinematics/units.hpp"

namespace demecal::inline data {
namespace {

constexpr double kLimitMargin_rad = radians(5.0);
constexpr double kLimitMargin_m = 0.010;
constexpr double kEqualJoints = 1e-6;  // rad or m: below any controller's resolution

void check_count(const ColumnMap& map, const std::vector<ColumnName>& columns, std::size_t expected,
                 const std::string& what) {
  if (columns.size() == expected) return;
  throw InputError(columns.empty() ? map.where : columns.front().where, "",
                   what + " must name " + std::to_string(expected) + " columns, not " + std::to_string(columns.size()));
}

void check_distinct(const ColumnMap& map) {
  std::set<std::string> seen;
  for (const ColumnName& column : map.all()) {
    if (!seen.insert(column.name).second) throw InputError(column.where, column.name, "is named twice under columns");
  }
}

std::string in_border_unit(double value, bool angle) {
  return angle ? number_text(value, degrees, radians) + " deg" : number_text(value, millimetres, metres) + " mm";
}

void check_limits(const MeasuredPose& pose, const Joint& joint, std::size_t index, const std::string& file) {
  if (joint.endless) return;
  const bool angle = is_revolute(joint);
  const double margin = angle ? kLimitMargin_rad : kLimitMargin_m;
  const double value = pose.joints[static_cast<Eigen::Index>(index)];
  if (value >= joint.lower - margin && value <= joint.upper + margin) return;
  throw InputError({file, pose.line}, in_border_unit(value, angle),
                   "is far outside the limits of joint " + std::to_string(index + 1) + ", " +
                       in_border_unit(joint.lower, angle) + " to " + in_border_unit(joint.upper, angle) +
                       "; correct the data, or the limits in the robot file");
}

using TableColumns = std::vector<TableColumn>;

/// The columns of a data set, found in its table.
struct PoseColumns {
  TableColumns joints, position, orientation, distances, approach;
  std::optional<TableColumn> payload, temperature, time, set, pose, target;
};

TableColumns find_all(const CsvTable& table, const std::vector<ColumnName>& names) {
  TableColumns columns;
  for (const ColumnName& name : names) columns.emplace_back(table, name);
  return columns;
}

TableColumns find_all(const CsvTable& table, const std::vector<ColumnName>& names, Quantity quantity,
                      const AssumedUnits& units) {
  TableColumns columns;
  for (const ColumnName& name : names) columns.emplace_back(table, name, quantity, units);
  return columns;
}

TableColumns find_joints(const CsvTable& table, const ColumnMap& map, const AssumedUnits& units, const Chain& chain) {
  TableColumns columns;
  for (std::size_t i = 0; i < map.joints.size(); ++i) {
    columns.emplace_back(table, map.joints[i], joint_quantity(chain.joints[i]), units);
  }
  return columns;
}

template <typename... Rest>
std::optional<TableColumn> find_one(const CsvTable& table, const std::optional<ColumnName>& name, const Rest&... rest) {
  if (!name) return std::nullopt;
  return TableColumn(table, *name, rest...);
}

PoseColumns find_columns(const CsvTable& table, const ColumnMap& map, const AssumedUnits& units, const Chain& chain) {
  return {.joints = find_joints(table, map, units, chain),
          .position = find_all(table, map.position, Quantity::length, units),
          .orientation = find_all(table, map.orientation),
          .distances = find_all(table, map.distances, Quantity::length, units),
          .approach = find_all(table, map.approach),
          .payload = find_one(table, map.payload, Quantity::mass, units),
          .temperature = find_one(table, map.temperature, Quantity::temperature, units),
          .time = find_one(table, map.time, Quantity::time, units),
          .set = find_one(table, map.set),
          .pose = find_one(table, map.pose),
          .target = find_one(table, map.target)};
}

template <typename Vector>
Vector read_vector(const TableColumns& columns, const CsvRow& row) {
  Vector values(static_cast<Eigen::Index>(columns.size()));
  for (std::size_t i = 0; i < columns.size(); ++i) values[static_cast<Eigen::Index>(i)] = columns[i].number(row);
  return values;
}

Eigen::Quaterniond read_orientation(const TableColumns& columns, const CsvRow& row) {
  constexpr double kNormTolerance = 1e-3;  // rounded decimals stay within it; Euler angles and swapped columns do not
  const Eigen::Vector4d wxyz = read_vector<Eigen::Vector4d>(columns, row);
  if (!(std::abs(wxyz.norm() - 1.0) <= kNormTolerance)) {
    columns.front().fail(row, "and its three neighbours have norm " + number_text(wxyz.norm()) +
                                  "; an orientation must be a unit quaternion w, x, y, z");
  }
  return Eigen::Quaterniond(wxyz[0], wxyz[1], wxyz[2], wxyz[3]).normalized();
}

ApproachSigns read_approach(const TableColumns& columns, const CsvRow& row) {
  const auto signs = read_vector<ApproachSigns>(columns, row);
  for (Eigen::Index i = 0; i < signs.size(); ++i) {
    if (signs[i] == -1.0 || signs[i] == 0.0 || signs[i] == 1.0) continue;
    columns[static_cast<std::size_t>(i)].fail(row, "must be -1, 0 or 1: the sign of the joint's last motion");
  }
  return signs;
}

std::vector<double> read_distances(const TableColumns& columns, const CsvRow& row) {
  std::vector<double> distances;
  for (const TableColumn& column : columns) {
    distances.push_back(column.number(row));
    if (distances.back() <= 0.0) column.fail(row, "must be positive: it is a measured length");
  }
  return distances;
}

double read_payload(const TableColumn& column, const CsvRow& row) {
  const double payload_kg = column.number(row);
  if (payload_kg < 0.0) column.fail(row, "must not be negative: it is a mass");
  return payload_kg;
}

PoseSet read_set(const TableColumn& column, const CsvRow& row) {
  if (column.text(row) == "calibration") return PoseSet::calibration;
  if (column.text(row) == "validation") return PoseSet::validation;
  if (column.text(row) == "accept") return PoseSet::accept;
  column.fail(row, "must be calibration, validation or accept");
}

std::string read_pose_id(const TableColumn& column, const CsvRow& row) {
  if (column.text(row).empty()) column.fail(row, "is empty where the name of a pose is expected");
  return column.text(row);
}

MeasuredPose read_pose(const PoseColumns& columns, const CsvRow& row) {
  MeasuredPose pose;
  pose.line = row.line;
  pose.joints = read_vector<JointVector>(columns.joints, row);
  if (!columns.position.empty()) pose.position_m = read_vector<Eigen::Vector3d>(columns.position, row);
  if (!columns.orientation.empty()) pose.orientation = read_orientation(columns.orientation, row);
  pose.distances_m = read_distances(columns.distances, row);
  if (!columns.approach.empty()) pose.approach = read_approach(columns.approach, row);
  if (columns.payload) pose.payload_kg = read_payload(*columns.payload, row);
  if (columns.temperature) pose.temperature_celsius = columns.temperature->number(row);
  if (columns.time) pose.time_s = columns.time->number(row);
  if (columns.set) pose.set = read_set(*columns.set, row);
  pose.pose_id = columns.pose ? read_pose_id(*columns.pose, row) : "line " + std::to_string(row.line);
  if (columns.target) pose.target = columns.target->text(row);
  return pose;
}

}  // namespace

Quantity joint_quantity(const Joint& joint) {
  return is_revolute(joint) ? Quantity::angle : Quantity::length;
}

void check_column_map(const ColumnMap& columns, const Chain& chain) {
  check_count(columns, columns.joints, chain.joints.size(), "columns.joints");
  if (!columns.position.empty()) check_count(columns, columns.position, 3, "columns.position");
  if (!columns.orientation.empty()) check_count(columns, columns.orientation, 4, "columns.orientation (w, x, y, z)");
  if (!columns.approach.empty()) check_count(columns, columns.approach, chain.joints.size(), "columns.approach");
  check_distinct(columns);
  if (columns.position.empty() && columns.orientation.empty() && columns.distances.empty()) {
    throw InputError(columns.where, "", "columns must name position, orientation or distances: nothing was measured");
  }
}

void check_targets(std::span<const MeasuredPose> poses, const std::map<std::string, Eigen::Vector3d>& tools_m,
                   const std::string& file) {
  std::vector<std::string> names;
  for (const auto& [name, tool] : tools_m) names.push_back(name);
  for (const MeasuredPose& pose : poses) {
    if (pose.target.empty() || tools_m.contains(pose.target)) continue;
    throw InputError({file, pose.line}, pose.target,
                     names.empty()
                         ? "is a target, but the data set has no tools_mm"
                         : "is no target of tools_mm; the nearest is '" + nearest_name(pose.target, names) + "'");
  }
}

void check_joint_limits(std::span<const MeasuredPose> poses, const Chain& chain, const std::string& file) {
  for (const MeasuredPose& pose : poses) {
    for (std::size_t i = 0; i < chain.joints.size(); ++i) check_limits(pose, chain.joints[i], i, file);
  }
}

void check_repeats(std::span<const MeasuredPose> poses, const std::string& file) {
  std::map<std::string, const MeasuredPose*> first;
  for (const MeasuredPose& pose : poses) {
    const auto [entry, is_first] = first.emplace(pose.pose_id, &pose);
    if (is_first) continue;
    const MeasuredPose& other = *entry->second;
    const std::string of_line = " those of line " + std::to_string(other.line) + ", which has the same pose id";
    if ((pose.joints - other.joints).cwiseAbs().maxCoeff() > kEqualJoints) {
      throw InputError({file, pose.line}, pose.pose_id, "joints differ from" + of_line);
    }
    if (pose.set != other.set) {
      throw InputError({file, pose.line}, pose.pose_id,
                       "is in another set than line " + std::to_string(other.line) + ", which has the same pose id");
    }
  }
}

std::vector<MeasuredPose> read_poses(const CsvTable& table, const ColumnMap& columns, const AssumedUnits& units,
                                     const Chain& chain, const std::map<std::string, Eigen::Vector3d>& tools_m) {
  check_column_map(columns, chain);
  const PoseColumns found = find_columns(table, columns, units, chain);
  std::vector<MeasuredPose> poses;
  poses.reserve(table.rows.size());
  for (const CsvRow& row : table.rows) poses.push_back(read_pose(found, row));
  check_targets(poses, tools_m, table.file);
  check_repeats(poses, table.file);
  return poses;
}

}  // namespace demecal::inline data
