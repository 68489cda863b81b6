// Where the flange and the tool are: forward kinematics and its derivatives by every joint and link parameter.
#pragma once

#include <Eigen/Geometry>

#include "kinematics/chain.hpp"

namespace demecal {

/// 6 x n: rows 0-2 linear (m per rad or m), rows 3-5 angular (rad per rad or m), in the base frame.
using Jacobian = Eigen::Matrix<double, 6, Eigen::Dynamic, 0, 6, kMaxJoints>;
/// 6 x (5 n): columns 5 i + LinkParameter of joint i, rows as in Jacobian.
using LinkJacobian = Eigen::Matrix<double, 6, Eigen::Dynamic, 0, 6, kMaxJoints * kLinkParameters>;

/// Pose of the flange in the base frame at joint values `q` (rad or m; size chain.size()): the product of the link
/// transforms, thesis A.2.
Eigen::Isometry3d forward(const Chain& chain, const JointVector& q);

/// Position of the chain's tool point in the base frame, m.
Eigen::Vector3d tool_position(const Chain& chain, const JointVector& q);

/// The analytic Jacobian by the joint variables of the point `point_m` fixed in the flange frame: J_i = z_i x (p -
/// o_i).
Jacobian joint_jacobian(const Chain& chain, const JointVector& q, const Eigen::Vector3d& point_m);

/// The analytic Jacobian of the same point by all link parameters, each taken as its elementary transform's twist.
LinkJacobian link_jacobian(const Chain& chain, const JointVector& q, const Eigen::Vector3d& point_m);

/// Everything at once, for solvers: the flange pose, and both Jacobians for one point.
struct Kinematics {
  Eigen::Isometry3d flange;
  Jacobian joints;
  LinkJacobian links;
};
Kinematics differential_kinematics(const Chain& chain, const JointVector& q, const Eigen::Vector3d& point_m);

}  // namespace demecal
