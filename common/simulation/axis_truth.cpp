#include "simulation/axis_truth.hpp"

#include <cmath>

namespace demecal {

void deform(Chain& chain, const GeometryError& error) {
  chain.joints[static_cast<std::size_t>(error.joint)].parameter(error.parameter) += error.value;
}

Eigen::Vector3d tilt(const AxisWobble& error, const Situation& situation) {
  const double angle = error.order * situation.commanded[error.joint];
  Eigen::Vector3d vector = Eigen::Vector3d::Zero();
  vector.head<2>() = std::cos(angle) * error.cosine_rad + std::sin(angle) * error.sine_rad;
  return vector;
}

}  // namespace demecal
