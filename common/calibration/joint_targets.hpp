// What each joint should learn: its error at every pose, told from what was measured.
#pragma once

#include <span>
#include <vector>

#include "calibration/target_options.hpp"
#include "effects/corrected_robot.hpp"
#include "fitting/observation.hpp"
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
  std::vector<double> weight;          ///< 1; of exact targets less near a singularity; 0 where no joints were found
  std::vector<AngleBranch> branches;   ///< one per joint
  std::vector<SingularPose> singular;  ///< of exact targets, named, in the order of poses
};

/// By what rule targets are made.
struct TargetRule {
  TargetOptions options;
  RowScales residuals{};                ///< of a fitted model, per kind (m, rad, m); 0: kinds not to be used
  std::vector<JointCorrection> mean{};  ///< errors learnt so far, one per joint; empty: none
};

/// The calibrated joint configuration of every named pose: where the joints of `robot`, a model without corrections,
/// really were. The error is how far they went beyond what was commanded, so that h(theta) = theta + g(theta) predicts
/// the real robot.
///
/// posterior: the most probable errors given the measured rows alone (most_probable_errors()). Before a pose is looked
/// at the error of a revolute joint is believed to be normal about the rule's mean with a standard deviation of
/// joint_error_rad; that of a prismatic joint with 0.2 m times as much (0.2 mm for 1 mrad). What no joint can explain,
/// and what these rows do not tell of a joint, stays as it was believed.
///
/// exact: the joints at which `robot` reaches the measured position with the orientation it predicts at the commanded
/// joints, or the measured pose where orientation was measured (thesis 4.5, note 40). Arms with more joints than needed
/// take the least-norm step. Where only distances were measured the position nearest to the predicted one that agrees
/// with them is used. Of the rule only the kind matters.
JointTargets joint_targets(const DataSet& data, std::span<const std::size_t> poses, const CorrectedRobot& robot,
                           const TargetRule& rule);

}  // namespace demecal
