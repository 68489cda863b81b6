// The most probable joint errors of a pose, from the rows that were measured alone.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "effects/corrected_robot.hpp"
#include "fitting/observation.hpp"

namespace demecal {

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

}  // namespace demecal
