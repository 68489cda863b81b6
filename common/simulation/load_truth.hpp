// True errors that follow from the weight of the links and the payload.
#pragma once

#include "simulation/situation.hpp"

namespace demecal {

/// Gear compliance, rad/Nm, under the weight of the links and the payload: the joint gives way where gravity pushes it.
struct Compliance {
  int joint = 0;
  double rad_per_nm = 0.0;
};

/// A joint's bearing, and the link before it, give way across the axis: the axis tilts about x and y of its own frame
/// by the moment of gravity there times these, rad/Nm.
struct LinkBending {
  int joint = 0;
  double x_rad_per_nm = 0.0;
  double y_rad_per_nm = 0.0;
};

/// What it adds to its joint's angle, rad (m, per N, for prismatic joints).
double deviation(const Compliance& error, const Situation& situation);
/// The rotation vector by which the axis tilts, rad, in the joint's axis frame.
Eigen::Vector3d tilt(const LinkBending& error, const Situation& situation);

}  // namespace demecal
