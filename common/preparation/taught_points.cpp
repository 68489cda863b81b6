#include "preparation/taught_points.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "errors/input_error.hpp"
#include "kinematics/forward.hpp"
#include "kinematics/units.hpp"

namespace demecal {
namespace {

constexpr std::array<std::array<std::size_t, 2>, 3> kPairs{{{0, 1}, {1, 2}, {2, 0}}};

bool has_poses(const Program& program) {
  return std::any_of(program.targets.begin(), program.targets.end(), [](const Target& t) { return t.is_pose(); });
}

void require_frame(const ThreePoints& points_m, const std::string& file) {
  const double height = relative_height(points_m);
  if (height >= kLeastRelativeHeight) return;
  throw InputError({file, 0}, "",
                   fmt::format("the three points of the local frame stand on a line: the third is off the line through "
                               "the other two by {:.4g} of the longest side, and must be by {} at least",
                               height, kLeastRelativeHeight));
}

double distance(const ThreePoints& points_m, const std::array<std::size_t, 2>& pair) {
  return (points_m[pair[0]] - points_m[pair[1]]).norm();
}

}  // namespace

RobotPoints robot_points(const Program& program, const std::string& points, const Robot& robot) {
  const PointKind kind = has_poses(program) ? PointKind::poses : PointKind::joints;
  RobotPoints found{program.file, named_points(program, kind, points), {}};
  if (found.names.size() != 3) {
    throw InputError({program.file, 0}, points,
                     fmt::format("has {} points where the three of the local frame are expected; name their array "
                                 "with local_frame.points",
                                 found.names.size()));
  }
  for (std::size_t i = 0; i < 3; ++i) {
    const Target& target = program.targets[found.names[i].target];
    if (kind == PointKind::poses) {
      for (std::size_t axis = 0; axis < 3; ++axis) {
        found.in_base_m[i][static_cast<Eigen::Index>(axis)] = target.position[axis].inside();
      }
      continue;
    }
    JointVector joints(robot.chain.size());
    for (Eigen::Index j = 0; j < joints.size(); ++j) joints[j] = target.joints[static_cast<std::size_t>(j)].inside();
    found.in_base_m[i] = tool_position(robot.chain, joints);
  }
  return found;
}

RobotPoints robot_points(const ThreePoints& in_base_m, const std::string& file) {
  RobotPoints points{file, {}, in_base_m};
  for (const char* name : {"1", "2", "3"}) points.names.push_back({points.names.size(), name, name, name});
  return points;
}

double largest_difference_m(const TaughtPoints& points) {
  double largest = 0.0;
  for (const auto& pair : kPairs) {
    largest = std::max(largest, std::abs(distance(points.in_base_m, pair) - distance(points.in_instrument_m, pair)));
  }
  return largest;
}

TaughtPoints taught_points(const RobotPoints& robot, const Readings& readings, double most_difference_m) {
  const auto rows = rows_of_points(readings, robot.names, robot.file);
  TaughtPoints points{robot.in_base_m, {}};
  for (std::size_t i = 0; i < 3; ++i) points.in_instrument_m[i] = average(readings, rows[i]).point_m;
  require_frame(points.in_base_m, robot.file);
  require_frame(points.in_instrument_m, readings.file);
  for (const auto& pair : kPairs) {
    const double base_mm = millimetres(distance(points.in_base_m, pair));
    const double instrument_mm = millimetres(distance(points.in_instrument_m, pair));
    if (std::abs(base_mm - instrument_mm) <= millimetres(most_difference_m)) continue;
    throw InputError({readings.file, 0}, "",
                     fmt::format("points {} and {} of the local frame are {:.3f} mm apart as measured, but {:.3f} mm "
                                 "in {}; the two must agree within {:.3f} mm (local_frame.tolerance_mm)",
                                 robot.names[pair[0]].name, robot.names[pair[1]].name, instrument_mm, base_mm,
                                 robot.file, millimetres(most_difference_m)));
  }
  return points;
}

}  // namespace demecal
