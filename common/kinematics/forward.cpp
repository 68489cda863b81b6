#include "kinematics/forward.hpp"

#include "kinematics/walk.hpp"

namespace demecal {
namespace {

constexpr auto kStays = [](int, Eigen::Isometry3d&) {};

}  // namespace

Eigen::Isometry3d forward(const Chain& chain, const JointVector& q) {
  return walk(
      chain, q, [](int, LinkParameter, const Screw&) {}, kStays);
}

Eigen::Vector3d tool_position(const Chain& chain, const JointVector& q) {
  return forward(chain, q) * chain.tool_m;
}

Kinematics differential_kinematics(const Chain& chain, const JointVector& q, const Eigen::Vector3d& point_m) {
  ScrewList screws;
  const Eigen::Isometry3d flange = walk(
      chain, q, [&](int joint, LinkParameter parameter, const Screw& screw) { screws(joint, parameter, screw); },
      kStays);
  return screws.kinematics(chain, flange, point_m);
}

Jacobian joint_jacobian(const Chain& chain, const JointVector& q, const Eigen::Vector3d& point_m) {
  return differential_kinematics(chain, q, point_m).joints;
}

LinkJacobian link_jacobian(const Chain& chain, const JointVector& q, const Eigen::Vector3d& point_m) {
  return differential_kinematics(chain, q, point_m).links;
}

}  // namespace demecal
