#include "fitting/base_candidates.hpp"

#include <Eigen/SVD>
#include <algorithm>
#include <cmath>
#include <numbers>

namespace demecal {
namespace {

/// The tool of an observation as the robot has it, in the robot's base.
Eigen::Vector3d point_in_base(const DataSet& data, const CorrectedRobot& robot, const Observation& observation) {
  return forward(robot.chain, observation.corrected) * robot.tool(data.poses[observation.pose].target).translation();
}

Eigen::Isometry3d standing(const Eigen::Matrix3d& rotation, const Eigen::Vector3d& point_in_base,
                           const Eigen::Vector3d& point_in_sensor) {
  Eigen::Isometry3d base = Eigen::Isometry3d::Identity();
  base.linear() = rotation;
  base.translation() = point_in_sensor - rotation * point_in_base;
  return base;
}

struct Points {
  Eigen::Matrix3Xd in_base;
  Eigen::Matrix3Xd in_sensor;
};

/// The points of the observations that measured a position.
Points measured_points(const DataSet& data, const std::vector<Observation>& observations, const CorrectedRobot& robot) {
  Points points;
  for (const Observation& observation : observations) {
    const MeasuredPose& pose = data.poses[observation.pose];
    if (!pose.position_m) continue;
    const Eigen::Index n = points.in_base.cols();
    points.in_base.conservativeResize(3, n + 1);
    points.in_sensor.conservativeResize(3, n + 1);
    points.in_base.col(n) = point_in_base(data, robot, observation);
    points.in_sensor.col(n) = *pose.position_m;
  }
  return points;
}

std::vector<Eigen::Isometry3d> by_points(const Points& points, int count) {
  std::vector<Eigen::Isometry3d> bases;
  bases.emplace_back(Eigen::umeyama(points.in_base, points.in_sensor, false));
  const Eigen::Vector3d base_middle = points.in_base.rowwise().mean(),
                        sensor_middle = points.in_sensor.rowwise().mean();
  for (int i = 0; i < count; ++i) bases.push_back(standing(spread_rotation(i, count), base_middle, sensor_middle));
  return bases;
}

/// No direction, the six of a cube's faces and the eight of its corners.
std::vector<Eigen::Vector3d> places_around() {
  std::vector<Eigen::Vector3d> places;
  for (int x = -1; x <= 1; ++x) {
    for (int y = -1; y <= 1; ++y) {
      for (int z = -1; z <= 1; ++z) {
        const int off = std::abs(x) + std::abs(y) + std::abs(z);
        if (off != 2) places.push_back(Eigen::Vector3d(x, y, z).stableNormalized());
      }
    }
  }
  return places;
}

struct Middle {
  Eigen::Vector3d in_base = Eigen::Vector3d::Zero();
  double distance_m = 0.0;
};

/// The mean point of the tool and its mean distance from the anchors.
Middle middle_of(const DataSet& data, const std::vector<Observation>& observations, const CorrectedRobot& robot) {
  Middle middle;
  double distances = 0.0;
  for (const Observation& observation : observations) {
    middle.in_base += point_in_base(data, robot, observation) / static_cast<double>(observations.size());
    for (const double distance : data.poses[observation.pose].distances_m)
      middle.distance_m += distance, distances += 1;
  }
  if (distances > 0) middle.distance_m /= distances;
  return middle;
}

double misfit(const DataSet& data, const std::vector<Observation>& observations, CorrectedRobot robot,
              const Eigen::Isometry3d& base) {
  robot.sensor_from_base = base;
  return root_mean_squares(data, robot, observations)[kDistance];
}

std::vector<Eigen::Isometry3d> by_distances(const DataSet& data, const std::vector<Observation>& observations,
                                            const CorrectedRobot& robot, int count) {
  const Middle middle = middle_of(data, observations, robot);
  Eigen::Vector3d anchors = Eigen::Vector3d::Zero();
  for (const Eigen::Vector3d& anchor : data.anchors_m) anchors += anchor / static_cast<double>(data.anchors_m.size());
  std::vector<std::pair<double, Eigen::Isometry3d>> ranked;
  for (int i = 0; i < count; ++i) {
    for (const Eigen::Vector3d& place : places_around()) {
      const Eigen::Isometry3d base =
          standing(spread_rotation(i, count), middle.in_base, anchors + middle.distance_m * place);
      ranked.emplace_back(misfit(data, observations, robot, base), base);
    }
  }
  std::stable_sort(ranked.begin(), ranked.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
  std::vector<Eigen::Isometry3d> bases;
  for (int i = 0; i < count; ++i) bases.push_back(ranked[static_cast<std::size_t>(i)].second);
  return bases;
}

}  // namespace

std::vector<Eigen::Isometry3d> base_candidates(const DataSet& data, const std::vector<Observation>& observations,
                                               const CorrectedRobot& robot, int count) {
  const Points points = measured_points(data, observations, robot);
  if (points.in_base.cols() > 0) return by_points(points, count);
  if (count_rows(data, observations)[kDistance] > 0) return by_distances(data, observations, robot, count);
  std::vector<Eigen::Isometry3d> bases;
  for (int i = 0; i < count; ++i) bases.emplace_back(spread_rotation(i, count));
  return bases;
}

Eigen::Matrix3d spread_rotation(int index, int count) {
  constexpr double kPsi = 1.533751168755204288118;  // the root of psi^4 = psi + 4
  const double s = index + 0.5, share = s / count;
  const double alpha = 2 * std::numbers::pi * s / std::numbers::sqrt2, beta = 2 * std::numbers::pi * s / kPsi;
  const double inner = std::sqrt(share), outer = std::sqrt(1 - share);
  return Eigen::Quaterniond(outer * std::cos(beta), inner * std::sin(alpha), inner * std::cos(alpha),
                            outer * std::sin(beta))
      .toRotationMatrix();
}

Eigen::Matrix3d nearest_rotation(const Eigen::Matrix3d& matrix) {
  const Eigen::JacobiSVD<Eigen::Matrix3d> svd(matrix, Eigen::ComputeFullU | Eigen::ComputeFullV);
  const double turn = (svd.matrixU() * svd.matrixV().transpose()).determinant();
  return svd.matrixU() * Eigen::Vector3d(1, 1, turn < 0 ? -1 : 1).asDiagonal() * svd.matrixV().transpose();
}

}  // namespace demecal
