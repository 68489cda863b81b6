// Arms that touch contacts: the joints at which the true robot stands there.
#pragma once

#include <string>

#include "fitting/known_arm.hpp"
#include "kinematics/inverse.hpp"

namespace demecal {

/// Adds poses in which the true tool point is within `play_m` (standard deviation per axis) of a point, in postures as
/// random as the arm can take.
inline void touch(KnownArm& arm, RandomStream& stream, const std::string& contact, const Eigen::Vector3d& at_m,
                  int count, double play_m, PoseSet set = PoseSet::calibration) {
  const Chain& chain = arm.data.robot.chain;
  const PoseFunction model = [&](const JointVector& q) { return arm.truth.predict_with_jacobian(Stop(q), ""); };
  for (int added = 0; added < count;) {
    JointVector q = random_joints(stream, chain);
    const Eigen::Vector3d goal = at_m + random_vector(stream, play_m);
    for (int step = 0; step < 60; ++step) {
      const PoseAndJacobian now = model(q);
      const Eigen::MatrixXd rows = now.jacobian.topRows<3>();
      const Eigen::Vector3d off = goal - now.pose.translation();
      const Eigen::MatrixXd damped = rows * rows.transpose() + 1e-6 * Eigen::Matrix3d::Identity();
      JointVector change = rows.transpose() * damped.ldlt().solve(off);
      const double largest = change.cwiseAbs().maxCoeff();
      if (largest > 0.3) change *= 0.3 / largest;
      q += change;
    }
    bool inside = (model(q).pose.translation() - goal).norm() < 1e-10;
    for (int joint = 0; joint < chain.size(); ++joint) {
      const Joint& link = chain.joints[static_cast<std::size_t>(joint)];
      inside = inside && q[joint] > link.lower && q[joint] < link.upper;
    }
    if (!inside) continue;
    MeasuredPose pose;
    pose.joints = q;
    pose.contact = contact;
    pose.set = set;
    pose.pose_id = contact + "-" + std::to_string(arm.data.poses.size());
    pose.line = arm.data.poses.size() + 2;
    arm.data.poses.push_back(pose);
    ++added;
  }
}

}  // namespace demecal
