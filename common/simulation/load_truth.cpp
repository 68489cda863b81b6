#include "simulation/load_truth.hpp"

namespace demecal {

double deviation(const Compliance& error, const Situation& situation) {
  return error.rad_per_nm * situation.loads[static_cast<std::size_t>(error.joint)].effort;
}

Eigen::Vector3d tilt(const LinkBending& error, const Situation& situation) {
  const Eigen::Vector3d& moment = situation.loads[static_cast<std::size_t>(error.joint)].moment_nm;
  return {error.x_rad_per_nm * moment.x(), error.y_rad_per_nm * moment.y(), 0.0};
}

}  // namespace demecal
