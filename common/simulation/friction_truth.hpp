// True errors of a joint that follow from the side it came from.
#pragma once

#include "simulation/situation.hpp"

namespace demecal {

/// Lost motion of the joint's gear, rad: the joint stops half of it short on either side, so that it stands at
/// q - s width / 2, s being the sign of its last motion.
struct Backlash {
  int joint = 0;
  double width_rad = 0.0;
};

/// Friction against the gear's spring: the joint stops short by friction_rad (1 + per_nm |tau|), tau being the torque
/// of gravity on it.
struct Hysteresis {
  int joint = 0;
  double friction_rad = 0.0;
  double per_nm = 0.0;
};

/// What each adds to its joint's angle, rad (m for prismatic joints).
double deviation(const Backlash& error, const Situation& situation);
double deviation(const Hysteresis& error, const Situation& situation);

}  // namespace demecal
