// Random arms and joints for property tests.
#pragma once

#include <algorithm>
#include <numbers>

#include "kinematics/chain.hpp"
#include "kinematics/forward.hpp"
#include "kinematics/inverse.hpp"
#include "random/random_stream.hpp"

namespace demecal {

inline constexpr Convention kConventions[] = {Convention::standard_dh, Convention::modified_dh};

/// Pose and Jacobian of the flange.
inline PoseFunction model_of(const Chain& chain) {
  return [chain](const JointVector& q) {
    const Kinematics at = differential_kinematics(chain, q, Eigen::Vector3d::Zero());
    return PoseAndJacobian{at.flange, at.joints};
  };
}

/// An arm with links of 0.1 to 0.5 m, any twist, and Hayati's beta on every link; each joint is prismatic with the
/// given probability. Limits are +-pi and +-0.5 m.
inline Chain random_arm(RandomStream& stream, int joints, Convention convention, double prismatic = 0.0) {
  constexpr double kPi = std::numbers::pi;
  Chain chain;
  chain.convention = convention;
  for (int i = 0; i < joints; ++i) {
    Joint joint;
    joint.type = stream.chance(prismatic) ? JointType::prismatic : JointType::revolute;
    joint.theta_rad = stream.real(-kPi, kPi);
    joint.d_m = stream.real(0.1, 0.5);
    joint.a_m = stream.real(0.1, 0.5);
    joint.alpha_rad = stream.real(-kPi, kPi);
    joint.beta_rad = stream.real(-0.5, 0.5);
    joint.upper = is_revolute(joint) ? kPi : 0.5;
    joint.lower = -joint.upper;
    chain.joints.push_back(joint);
  }
  for (double& coordinate : chain.tool_m) coordinate = stream.real(-0.2, 0.2);
  return chain;
}

inline Eigen::Isometry3d random_place(RandomStream& stream) {
  const Eigen::Quaterniond turn(stream.normal(), stream.normal(), stream.normal(), stream.normal());
  Eigen::Isometry3d place(turn.normalized());
  for (double& coordinate : place.translation()) coordinate = stream.real(-0.3, 0.3);
  return place;
}

/// A random arm that stands on something and carries something, and whose joints 2 and 3, where they are of one type,
/// are also turned by the commands of those before.
inline Chain mounted_arm(RandomStream& stream, int joints, Convention convention, double prismatic = 0.0) {
  Chain chain = random_arm(stream, joints, convention, prismatic);
  chain.base = random_place(stream);
  chain.flange = random_place(stream);
  for (int joint = 1; joint < std::min(joints, 3); ++joint) {
    for (int from = 0; from < joint; ++from) {
      if (is_revolute(chain, from) == is_revolute(chain, joint))
        chain.couplings.push_back({joint, from, stream.real(-0.5, 0.5)});
    }
  }
  return chain;
}

/// Uniform between the joints' limits.
inline JointVector random_joints(RandomStream& stream, const Chain& chain) {
  JointVector q(chain.size());
  for (int i = 0; i < chain.size(); ++i) {
    const Joint& joint = chain.joints[static_cast<std::size_t>(i)];
    q[i] = stream.real(joint.lower, joint.upper);
  }
  return q;
}

/// A vector of `size` numbers within +-`largest`.
inline JointVector random_change(RandomStream& stream, int size, double largest) {
  JointVector change(size);
  for (int i = 0; i < size; ++i) change[i] = stream.real(-largest, largest);
  return change;
}

/// A 6-joint elbow arm with a spherical wrist and the lengths of the PUMA 761 (thesis table A-1), tool along the flange
/// axis. Its wrist is singular where joint 5 is zero, its elbow at joint 3 = +-pi / 2.
inline Chain wrist_arm() {
  constexpr double kRight = std::numbers::pi / 2;
  Chain chain;
  const auto link = [&](double alpha_rad, double a_m, double d_m) {
    Joint joint;
    joint.alpha_rad = alpha_rad;
    joint.a_m = a_m;
    joint.d_m = d_m;
    joint.lower = -std::numbers::pi;
    joint.upper = std::numbers::pi;
    chain.joints.push_back(joint);
  };
  link(-kRight, 0.0, 0.0);
  link(0.0, 0.650, 0.191);
  link(kRight, 0.0, 0.0);
  link(-kRight, 0.0, 0.600);
  link(kRight, 0.0, 0.0);
  link(0.0, 0.0, 0.125);
  chain.tool_m = {0.0, 0.0, 0.1};
  return chain;
}

}  // namespace demecal
