#include "preparation/taught_points.hpp"

#include <fmt/format.h>
#include <Eigen/Core>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>

#include "decompositions/decompositions.hpp"
#include "errors/check.hpp"
#include "errors/input_error.hpp"
#include "kinematics/chain.hpp"
#include "kinematics/forward.hpp"
#include "kinematics/units.hpp"

namespace demecal::inline preparation {
namespace {

Eigen::Matrix3Xd columns_of(const std::vector<Eigen::Vector3d>& points) {
  Eigen::Matrix3Xd columns(3, static_cast<Eigen::Index>(points.size()));
  for (std::size_t i = 0; i < points.size(); ++i) columns.col(static_cast<Eigen::Index>(i)) = points[i];
  return columns;
}

/// Whether the points spread in two directions at least, so that no turn about a line goes unseen.
bool spread_out(const Eigen::Matrix3Xd& points) {
  constexpr double kLeast = 1e-6;
  if (points.cols() < 3) return false;
  const Eigen::Matrix3Xd centred = points.colwise() - points.rowwise().mean();
  const Eigen::VectorXd spread = singular_system(centred).values;
  return spread[1] > kLeast * spread[0];
}

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

double side_length(const ThreePoints& points_m, const std::array<std::size_t, 2>& pair) {
  return (points_m[pair[0]] - points_m[pair[1]]).norm();
}

}  // namespace

double relative_height(const ThreePoints& points_m) {
  const Eigen::Vector3d side = points_m[1] - points_m[0], other = points_m[2] - points_m[0];
  const double longest = std::max({side.norm(), other.norm(), (points_m[2] - points_m[1]).norm()});
  if (!(side.norm() > 0.0)) return 0.0;
  return side.cross(other).norm() / side.norm() / longest;
}

Eigen::Isometry3d local_frame(const ThreePoints& points_m) {
  DEMECAL_CHECK(relative_height(points_m) > 0.0, "three points on a line");
  const Eigen::Vector3d x = (points_m[1] - points_m[0]).normalized();
  const Eigen::Vector3d z = x.cross(points_m[2] - points_m[0]).normalized();
  Eigen::Isometry3d frame = Eigen::Isometry3d::Identity();
  frame.linear() << x, z.cross(x), z;
  frame.translation() = points_m[0];
  return frame;
}

Eigen::Isometry3d three_point_frame(const ThreePoints& in_base_m, const ThreePoints& in_instrument_m) {
  return local_frame(in_base_m) * local_frame(in_instrument_m).inverse(Eigen::Isometry);
}

std::optional<Eigen::Isometry3d> best_fit(const std::vector<Eigen::Vector3d>& from,
                                          const std::vector<Eigen::Vector3d>& to) {
  DEMECAL_CHECK(from.size() == to.size(), from.size() << " and " << to.size() << " points");
  const Eigen::Matrix3Xd source = columns_of(from), target = columns_of(to);
  if (!spread_out(source) || !spread_out(target)) return std::nullopt;
  return rigid_motion(source, target);
}

double misfit(const Eigen::Isometry3d& motion, const std::vector<Eigen::Vector3d>& from,
              const std::vector<Eigen::Vector3d>& to) {
  double sum = 0.0;
  for (std::size_t i = 0; i < from.size(); ++i) sum += (motion * from[i] - to[i]).squaredNorm();
  return from.empty() ? 0.0 : std::sqrt(sum / static_cast<double>(from.size()));
}

bool is_mirrored(const std::vector<Eigen::Vector3d>& from, const std::vector<Eigen::Vector3d>& to) {
  constexpr double kFarBetter = 0.2;
  std::vector<Eigen::Vector3d> image = from;
  for (Eigen::Vector3d& point : image) point.z() = -point.z();
  const auto as_is = best_fit(from, to), as_image = best_fit(image, to);
  return as_is && as_image && misfit(*as_image, image, to) < kFarBetter * misfit(*as_is, from, to);
}

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
    require_kept_numbers(program, found.names[i].target);
    if (kind == PointKind::poses) {
      found.in_base_m[i] = point_in_base(program, found.names[i].target);
      continue;
    }
    found.in_base_m[i] = tool_position(robot.chain, stated_joints(program.targets[found.names[i].target]));
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
    largest =
        std::max(largest, std::abs(side_length(points.in_base_m, pair) - side_length(points.in_instrument_m, pair)));
  }
  return largest;
}

TaughtPoints taught_points(const RobotPoints& robot, const Readings& readings, double tolerance_m) {
  const auto rows = rows_of_points(readings, robot.names, robot.file);
  TaughtPoints points{robot.in_base_m, {}};
  for (std::size_t i = 0; i < 3; ++i) points.in_instrument_m[i] = average(readings, rows[i]).point_m;
  require_frame(points.in_base_m, robot.file);
  require_frame(points.in_instrument_m, readings.file);
  for (const auto& pair : kPairs) {
    const double base_mm = millimetres(side_length(points.in_base_m, pair));
    const double instrument_mm = millimetres(side_length(points.in_instrument_m, pair));
    if (std::abs(base_mm - instrument_mm) <= millimetres(tolerance_m)) continue;
    throw InputError({readings.file, 0}, "",
                     fmt::format("points {} and {} of the local frame are {:.3f} mm apart as measured, but {:.3f} mm "
                                 "in {}; the two must agree within {:.3f} mm (local_frame.tolerance_mm)",
                                 robot.names[pair[0]].name, robot.names[pair[1]].name, instrument_mm, base_mm,
                                 robot.file, millimetres(tolerance_m)));
  }
  return points;
}

}  // namespace demecal::inline preparation
