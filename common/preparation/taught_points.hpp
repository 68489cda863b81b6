// From the instrument's frame to the robot's base: by three taught points (thesis A.1.1), or by all measured ones.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <array>
#include <optional>
#include <string>
#include <vector>

#include "data/data_set.hpp"
#include "parsed_programs/program.hpp"
#include "preparation/named_points.hpp"
#include "preparation/readings.hpp"

namespace demecal::inline preparation {

using ThreePoints = std::array<Eigen::Vector3d, 3>;

/// How far the third point stands from the line through the other two, over the longest side; 0 where points coincide.
double relative_height(const ThreePoints& points_m);
/// Below it three points make no frame.
inline constexpr double kLeastRelativeHeight = 0.01;

/// The local frame of three points: origin in the first, x axis towards the second, y axis at right angles to it
/// towards the third. The points must have a relative height above 0.
Eigen::Isometry3d local_frame(const ThreePoints& points_m);

/// base_from_instrument = T_RL T_CL^-1 (thesis A.1.1), from three points known in both frames.
Eigen::Isometry3d three_point_frame(const ThreePoints& in_base_m, const ThreePoints& in_instrument_m);

/// The motion that brings `from` nearest to `to` (least squares of all, no scale; Umeyama 1991). Nothing where there
/// are fewer than three points, or where those of either list lie on one line.
std::optional<Eigen::Isometry3d> best_fit(const std::vector<Eigen::Vector3d>& from,
                                          const std::vector<Eigen::Vector3d>& to);

/// Root mean square of the distances of motion * from[i] to to[i].
double misfit(const Eigen::Isometry3d& motion, const std::vector<Eigen::Vector3d>& from,
              const std::vector<Eigen::Vector3d>& to);

/// Whether the points fit their mirror image far better than themselves: a frame with an axis the wrong way round.
bool is_mirrored(const std::vector<Eigen::Vector3d>& from, const std::vector<Eigen::Vector3d>& to);

/// Where the robot says the points are.
struct RobotPoints {
  std::string file;
  std::vector<NamedPoint> names;
  ThreePoints in_base_m;
};

/// Three points as a program has them: transformation points or, where it has none, precision points at which the
/// nominal arm's tool stands. Those of the array `points` alone where that is not empty. Throws InputError unless there
/// are three.
RobotPoints robot_points(const Program& program, const std::string& points, const Robot& robot);

/// The same from coordinates in the preparation file; readings name them "1", "2" and "3".
RobotPoints robot_points(const ThreePoints& in_base_m, const std::string& file);

struct TaughtPoints {
  ThreePoints in_base_m, in_instrument_m;

  Eigen::Isometry3d base_from_instrument() const { return three_point_frame(in_base_m, in_instrument_m); }
};

/// The largest difference that any of the three distances between the points has in the two frames, m.
double largest_difference_m(const TaughtPoints& points);

/// Averages the readings of each point. Throws InputError where readings are missing or of other points, where the
/// points stand on a line in either frame, or where a distance between two of them differs by more than
/// `tolerance_m` in the two frames: no rigid motion brings such points together.
TaughtPoints taught_points(const RobotPoints& robot, const Readings& readings, double tolerance_m);

}  // namespace demecal::inline preparation
