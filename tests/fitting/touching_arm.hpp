// Arms that touch contacts: the joints at which the true robot stands there.
#pragma once

#include <cmath>
#include <string>

#include "decompositions/decompositions.hpp"
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
      JointVector change = rows.transpose() * PivotedCholesky(damped).solve(off);
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

/// The same of a ball, all round its upper half: of unknown radius to the data.
inline void touch_ball(KnownArm& arm, RandomStream& stream, const std::string& ball, const Eigen::Vector3d& centre_m,
                       double radius_m, int count, double play_m, PoseSet set = PoseSet::calibration) {
  for (int i = 0; i < count; ++i) {
    Eigen::Vector3d out = random_vector(stream, 1.0).normalized();
    out.z() = std::abs(out.z());
    touch(arm, stream, ball, centre_m + radius_m * out, 1, play_m, set);
    arm.data.poses.back().contact_kind = ContactKind::sphere;
  }
  arm.data.contacts.forms[ball] = {ContactKind::sphere, {}};
}

/// The same of a level plate, anywhere within `half_m` of its middle.
inline void touch_plate(KnownArm& arm, RandomStream& stream, const std::string& plate, const Eigen::Vector3d& middle_m,
                        double half_m, int count, double play_m, PoseSet set = PoseSet::calibration) {
  for (int i = 0; i < count; ++i) {
    const Eigen::Vector3d off(stream.real(-half_m, half_m), stream.real(-half_m, half_m), 0.0);
    touch(arm, stream, plate, middle_m + off, 1, play_m, set);
    arm.data.poses.back().contact_kind = ContactKind::plane;
  }
  arm.data.contacts.forms[plate].kind = ContactKind::plane;
}

}  // namespace demecal
