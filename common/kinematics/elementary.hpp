// The elementary transforms a link is made of, in order, each a rotation about or a translation along one axis.
#pragma once

#include <Eigen/Geometry>
#include <array>

#include "kinematics/chain.hpp"

namespace demecal {

struct Elementary {
  LinkParameter parameter;
  bool rotates;  ///< about the axis; otherwise it translates along it
  int axis;      ///< 0 x, 1 y, 2 z, of the frame it stands in
};

/// The order of a link's transforms: standard Rz Tz Tx Rx Ry, modified Rx Tx Ry Rz Tz (the y rotation is Hayati's).
const std::array<Elementary, kLinkParameters>& elementary_transforms(Convention convention);

/// The value of an elementary transform of a joint whose variable is `q`, rad or m.
double elementary_value(const Joint& joint, LinkParameter parameter, double q);

/// `frame` moved by an elementary transform of the given value.
void advance(Eigen::Isometry3d& frame, const Elementary& transform, double value);

}  // namespace demecal
