// True errors of the axes themselves: links made a little wrong, and axes that wobble as they turn.
#pragma once

#include "simulation/situation.hpp"

namespace demecal {

/// An error of a link parameter, rad or m, joint from 0.
struct GeometryError {
  int joint = 0;
  LinkParameter parameter = LinkParameter::theta;
  double value = 0.0;
};

/// A turning axis that wobbles n times a turn: it tilts about x and y of its own frame by
/// cosine_rad cos(n theta) + sine_rad sin(n theta).
struct AxisWobble {
  int joint = 0;
  int order = 1;
  Eigen::Vector2d cosine_rad = Eigen::Vector2d::Zero();
  Eigen::Vector2d sine_rad = Eigen::Vector2d::Zero();
};

/// The error added to its link parameter.
void deform(Chain& chain, const GeometryError& error);
/// The rotation vector by which the axis tilts, rad, in the joint's axis frame.
Eigen::Vector3d tilt(const AxisWobble& error, const Situation& situation);

}  // namespace demecal
