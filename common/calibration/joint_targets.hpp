// What each joint should learn: its error at every pose, by inverse kinematics of what was measured.
#pragma once

#include <span>
#include <vector>

#include "effects/corrected_robot.hpp"
#include "kinematics/inverse.hpp"

namespace demecal {

/// A pose whose joints the measurement hardly determines.
struct SingularPose {
  std::size_t pose = 0;            ///< index in DataSet::poses
  double smallest_singular = 0.0;  ///< of the scaled Jacobian
  InverseStatus status = InverseStatus::damped;
};

/// Row k belongs to data.poses[poses[k]].
struct JointTargets {
  std::vector<std::size_t> poses;
  std::vector<JointVector> commanded;  ///< theta_N, each joint on its branch, rad or m
  std::vector<JointVector> error;      ///< theta_C - theta_N, within half a turn, rad or m
  std::vector<double> weight;          ///< 1, less near a singularity, 0 where no joints were found
  std::vector<AngleBranch> branches;   ///< one per joint
  std::vector<SingularPose> singular;  ///< named, in the order of poses
};

/// The calibrated joint configuration of every named pose: the joints at which `robot` reaches the measured position
/// with the orientation it predicts at the commanded joints, or the measured pose where orientation was measured
/// (thesis 4.5, note 40). Arms with more joints than needed take the least-norm step. Where only distances were
/// measured the position nearest to the predicted one that agrees with them is used. The error is how far the joints
/// really went beyond what was commanded, so that h(theta) = theta + g(theta) predicts the real robot.
JointTargets joint_targets(const DataSet& data, std::span<const std::size_t> poses, const CorrectedRobot& robot);

}  // namespace demecal
