#include "kinematics/joint_kinematics.hpp"

#include <array>
#include <cstddef>

namespace demecal::inline kinematics {

JointKinematics joint_kinematics(const FixedTurns& turns, const JointVector& q, const Eigen::Vector3d& point_m) {
  const Chain& chain = turns.chain();
  std::array<Screw, kMaxJoints> axes;
  JointKinematics result;
  const auto keep_axis = [&](int joint, LinkParameter parameter, const Screw& screw) {
    const auto index = static_cast<std::size_t>(joint);
    if (parameter == moving_parameter(chain.joints[index])) axes[index] = screw;
  };
  result.flange = walk(chain, turns, q, keep_axis, [](int, Eigen::Isometry3d&) {});
  const Eigen::Vector3d point = result.flange * point_m;
  Jacobian drives(6, chain.size());
  for (int joint = 0; joint < chain.size(); ++joint)
    drives.col(joint) = twist_at(axes[static_cast<std::size_t>(joint)], point);
  result.joints = drives;
  for (const CommandCoupling& coupling : chain.couplings)
    result.joints.col(coupling.from) += coupling.factor * drives.col(coupling.joint);
  return result;
}

}  // namespace demecal::inline kinematics
