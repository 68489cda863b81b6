#include "simulation/instrument_truth.hpp"

#include "simulation/stance.hpp"

namespace demecal {

Eigen::Isometry3d drifted(const Eigen::Isometry3d& pose, const Drift& drift, double time_s) {
  Eigen::Isometry3d crept = Eigen::Isometry3d::Identity();
  crept.linear() = rotation_by(time_s * drift.rad_per_s).toRotationMatrix();
  crept.translation() = time_s * drift.metres_per_s;
  return crept * pose;
}

Eigen::Vector3d scaled(const Eigen::Vector3d& point_m, const SensorScale& scale) {
  return (1.0 + scale.share) * point_m;
}

}  // namespace demecal
