// True errors of the instrument: it creeps away from the robot, and its metre is not a metre.
#pragma once

#include <Eigen/Geometry>

namespace demecal {

/// The base creeps through the sensor's frame: a translation and a rotation (about the sensor's origin) that grow with
/// time.
struct Drift {
  Eigen::Vector3d metres_per_s = Eigen::Vector3d::Zero();
  Eigen::Vector3d rad_per_s = Eigen::Vector3d::Zero();
};

/// Lengths are measured (1 + share) times as long as they are.
struct SensorScale {
  double share = 0.0;
};

/// `pose` (sensor's frame) as it stands `time_s` after the first pose.
Eigen::Isometry3d drifted(const Eigen::Isometry3d& pose, const Drift& drift, double time_s);
/// What the instrument reads for a point (sensor's frame, m).
Eigen::Vector3d scaled(const Eigen::Vector3d& point_m, const SensorScale& scale);

}  // namespace demecal
