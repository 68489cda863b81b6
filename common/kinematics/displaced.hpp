// Where the flange is when every joint's axis, and the flange, has moved a little from its place.
#pragma once

#include <array>

#include "kinematics/forward.hpp"

namespace demecal {

/// A small rigid motion in the axes of the frame it moves: a shift (m) by the first three, after a turn by the rotation
/// vector (rad) of the last three about the shifted origin.
using SmallMotion = Eigen::Matrix<double, 6, 1>;
/// Column i < n: of the frame whose z is the axis of joint i, before the joint's own motion; column n: of the flange.
using PlaceMotions = Eigen::Matrix<double, 6, Eigen::Dynamic, 0, 6, kMaxJoints + 1>;

/// `frame` after the motion.
Eigen::Isometry3d moved(const Eigen::Isometry3d& frame, const SmallMotion& motion);

/// The twist (linear m, angular rad, base frame) of a point, given in the base frame, per unit of component `axis` of
/// the motion `motion` of `frame`.
SmallMotion unit_twist(const Eigen::Isometry3d& frame, const SmallMotion& motion, int axis,
                       const Eigen::Vector3d& point);

/// Pose of the flange in the base frame with the places moved; `motions` has chain.size() + 1 columns.
Eigen::Isometry3d forward(const Chain& chain, const JointVector& q, const PlaceMotions& motions);

/// The same with the Jacobians, and where the places stand (base frame) before their motions.
struct DisplacedKinematics {
  Kinematics at;
  std::array<Eigen::Isometry3d, kMaxJoints + 1> places;
};
DisplacedKinematics differential_kinematics(const Chain& chain, const JointVector& q, const Eigen::Vector3d& point_m,
                                            const PlaceMotions& motions);

}  // namespace demecal
