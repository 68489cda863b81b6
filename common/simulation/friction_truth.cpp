#include "simulation/friction_truth.hpp"

#include <cmath>

namespace demecal {

double deviation(const Backlash& error, const Situation& situation) {
  return -0.5 * error.width_rad * situation.approach[error.joint];
}

double deviation(const Hysteresis& error, const Situation& situation) {
  const double load = std::abs(situation.loads[static_cast<std::size_t>(error.joint)].effort);
  return -error.friction_rad * situation.approach[error.joint] * (1.0 + error.per_nm * load);
}

}  // namespace demecal
