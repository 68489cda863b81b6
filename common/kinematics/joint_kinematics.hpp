// Where the flange is and how a tool point moves with the joints, and no more: for searches that ask at many joints.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>

#include "kinematics/forward.hpp"

namespace demecal::inline kinematics {

/// Of differential_kinematics() the flange and the Jacobian by the commanded joints, the same to the bit.
struct JointKinematics {
  Eigen::Isometry3d flange;
  Jacobian joints;
};
JointKinematics joint_kinematics(const FixedTurns& turns, const JointVector& q, const Eigen::Vector3d& point_m);

}  // namespace demecal::inline kinematics
