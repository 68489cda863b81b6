// What each joint should learn: its error at every pose, estimated from what was measured.
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "calibration/job.hpp"
#include "data/data_set.hpp"
#include "kinematics/angles.hpp"
#include "kinematics/chain.hpp"
#include "kinematics/inverse.hpp"
#include "parameters/observation.hpp"
#include "prediction/corrected_robot.hpp"

namespace demecal::inline calibration {

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
/// and what these rows do not show of a joint, stays as it was believed.
///
/// exact: the joints at which `robot` reaches the measured position with the orientation it predicts at the commanded
/// joints, or the measured pose where orientation was measured (thesis 4.5, note 40). Arms with more joints than needed
/// take the least-norm step. Where only distances were measured the position nearest to the predicted one that agrees
/// with them is used. Of the rule only the kind matters.
JointTargets joint_targets(const DataSet& data, std::span<const std::size_t> poses, const CorrectedRobot& robot,
                           const TargetRule& rule);

/// What is believed of the joints' errors before a pose is looked at: independent, normal.
struct JointBelief {
  Eigen::VectorXd deviation;          ///< one per joint, rad or m; 0: the joint has the mean's error
  std::vector<JointCorrection> mean;  ///< one per joint, or empty: zero
  Eigen::VectorXd mean_at(const JointVector& commanded) const;  ///< rad or m
};

/// What the rows scatter by beside the joints' errors, per kind (m, rad, m), 0 where a kind is not used. `residuals`
/// are the scales of what a model leaves, joints' errors included: one share of them all, chosen so that the poses are
/// most probable (their residuals are normal with J S J^T + Sigma), but no less than a good instrument.
RowScales measurement_scales(const DataSet& data, std::span<const std::size_t> poses, const CorrectedRobot& robot,
                             const JointBelief& belief, const RowScales& residuals);

/// The errors dq at which the density of the joints' errors, given the pose's rows, is largest: Gauss's steps
/// m + S J^T (J S J^T + Sigma)^-1 (e + J (dq - m)), e and J over the measured rows at the last dq, until they move
/// nothing. No value where they do not settle.
std::optional<JointVector> most_probable_errors(const DataSet& data, const MeasuredPose& pose,
                                                const CorrectedRobot& robot, const JointBelief& belief,
                                                const RowScales& scales);

}  // namespace demecal::inline calibration
