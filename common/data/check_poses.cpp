#include <Eigen/Core>
#include <cstddef>
#include <map>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "data/columns.hpp"
#include "data/data_set.hpp"
#include "data/read_poses.hpp"
#include "data/text.hpp"
#include "errors/input_error.hpp"
#include "kinematics/chain.hpp"
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
  std::set<std::pair<std::size_t, std::string>> seen;
  for (const ColumnName& column : map.all()) {
    const std::string name = column.number > 0 ? "column " + std::to_string(column.number) : column.name;
    if (!seen.insert({column.table, name}).second) throw InputError(column.where, name, "is named twice under columns");
  }
}

std::string in_border_unit(double value, bool angle) {
  return angle ? number_text(value, degrees, radians) + " deg" : number_text(value, millimetres, metres) + " mm";
}

void check_within_limits(const MeasuredPose& pose, const Joint& joint, std::size_t index, const std::string& file) {
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

void check_sigma(const ColumnMap& columns) {
  if (columns.sigma.size() != 1) check_count(columns, columns.sigma, 3, "columns.sigma (or one for all axes)");
  if (!columns.position.empty()) return;
  throw InputError(columns.sigma.front().where, columns.sigma.front().name,
                   "is the uncertainty of a position, and columns.position is missing");
}

}  // namespace

void check_column_map(const ColumnMap& columns, const Chain& chain) {
  check_count(columns, columns.joints, chain.joints.size(), "columns.joints");
  if (!columns.position.empty()) check_count(columns, columns.position, 3, "columns.position");
  if (!columns.sigma.empty()) check_sigma(columns);
  if (!columns.orientation.empty()) check_count(columns, columns.orientation, 4, "columns.orientation (w, x, y, z)");
  if (!columns.approach.empty()) check_count(columns, columns.approach, chain.joints.size(), "columns.approach");
  if (!columns.torque.empty()) check_count(columns, columns.torque, chain.joints.size(), "columns.torque");
  if (!columns.torque.empty() && chain.positioner > 0)
    throw InputError(columns.torque.front().where, columns.torque.front().name,
                     "is the torque that holds a weight, which turns with the workpiece that a positioner carries: "
                     "leave columns.torque out");
  check_distinct(columns);
  if (columns.position.empty() && columns.orientation.empty() && columns.distances.empty() && !columns.contact) {
    throw InputError(columns.where, "",
                     "columns must name position, orientation, distances or contact: nothing was measured");
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

void require_something_measured(std::span<const MeasuredPose> poses, const ColumnName& contact,
                                const std::string& file) {
  for (const MeasuredPose& pose : poses) {
    if (!pose.contact.empty() || pose.position_m || pose.orientation || !pose.distances_m.empty()) continue;
    throw InputError({file, pose.line}, "",
                     "column " + contact.name + " is empty and nothing else was measured: every " +
                         "row names what the tool touches, or has measured columns");
  }
}

void check_joint_limits(std::span<const MeasuredPose> poses, const Chain& chain, const std::string& file) {
  for (const MeasuredPose& pose : poses) {
    for (std::size_t i = 0; i < chain.joints.size(); ++i) check_within_limits(pose, chain.joints[i], i, file);
  }
}

void check_repeats(std::span<const MeasuredPose> poses, const std::string& file, bool joined) {
  constexpr double kFarthest_m = 5e-3;  ///< that no arm repeats worse than
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
    if (!joined || !pose.position_m || !other.position_m || pose.target != other.target) continue;
    const double apart_m = (*pose.position_m - *other.position_m).norm();
    if (apart_m > kFarthest_m)
      throw InputError({file, pose.line}, pose.pose_id,
                       "was measured " + number_text(std::round(millimetres(apart_m))) + " mm from the point of line " +
                           std::to_string(other.line) +
                           ", which has the same name: repeats of one pose are not so far apart. Correct the name of "
                           "the one that is another point, or take it out");
  }
}

}  // namespace demecal::inline data
