// Triangles, points and rigid motions drawn at random, and what an instrument would read of them.
#pragma once

#include <Eigen/Geometry>
#include <cmath>
#include <sstream>
#include <string>
#include <vector>

#include "data/csv.hpp"
#include "preparation/readings.hpp"
#include "random/random_stream.hpp"

namespace demecal {

inline Eigen::Vector3d random_point(RandomStream& stream, double reach) {
  Eigen::Vector3d point;
  for (double& coordinate : point) coordinate = stream.real(-reach, reach);
  return point;
}

inline Eigen::Isometry3d random_motion(RandomStream& stream) {
  Eigen::Isometry3d motion = Eigen::Isometry3d::Identity();
  motion.linear() = Eigen::Quaterniond(stream.normal(), stream.normal(), stream.normal(), stream.normal())
                        .normalized()
                        .toRotationMatrix();
  motion.translation() = random_point(stream, 2.0);
  return motion;
}

/// Sides of a triangle that is no line.
inline CordTriangle random_triangle(RandomStream& stream) {
  const Eigen::Vector2d b(stream.real(0.5, 2.0), 0.0), c(stream.real(-1.0, 2.0), stream.real(0.4, 2.0));
  return {b.norm(), (c - b).norm(), c.norm()};
}

inline std::vector<Eigen::Vector3d> random_points(RandomStream& stream, std::size_t count) {
  std::vector<Eigen::Vector3d> points;
  while (points.size() < count) points.push_back(random_point(stream, 1.0));
  return points;
}

inline CsvTable table_of(const std::string& text) {
  std::istringstream stream(text);
  return read_csv(stream, "readings.csv");
}

}  // namespace demecal
