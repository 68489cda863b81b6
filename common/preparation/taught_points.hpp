// The three points of the local frame, as the robot was taught them and as the instrument saw them.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "data/data_set.hpp"
#include "preparation/frames.hpp"
#include "preparation/named_points.hpp"

namespace demecal {

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
/// `most_difference_m` in the two frames: no rigid motion brings such points together.
TaughtPoints taught_points(const RobotPoints& robot, const Readings& readings, double most_difference_m);

}  // namespace demecal
