// The performance index of a whole model (thesis eq. 4.6): exact, and linearised in the joints' corrections.
#pragma once

#include <Eigen/Core>
#include <span>
#include <vector>

#include "effects/corrected_robot.hpp"
#include "fitting/fit.hpp"

namespace demecal {

/// What a pose says near the present corrections: rows that the index squares, and how they fall as joints are
/// corrected further.
struct LinearisedPose {
  JointVector correction;    ///< present g, rad or m
  Eigen::VectorXd left_mm;   ///< measured less predicted
  Eigen::MatrixXd slope_mm;  ///< rows x joints: change of the prediction, mm per rad or m of a joint's correction
};

/// The sum over `poses` of squared rows of what was measured, mm^2: positions and distances (those of one pose together
/// count as one length, and only where there is no position) by their errors, orientations by the turn that is left,
/// weighed as the declared fit found both to scatter. Where no orientation is used it is performance_index_mm2().
class DistalIndex {
 public:
  /// `declared` says how rows scatter; robots that are asked about have the effects of its robot.
  DistalIndex(const DataSet& data, std::span<const std::size_t> poses, const Fit& declared);

  /// Exact, through the robot's whole forward model.
  double operator()(const CorrectedRobot& robot) const;
  /// One per pose, in their order.
  std::vector<LinearisedPose> linearised(const CorrectedRobot& robot) const;

 private:
  Eigen::VectorXd weigh(const MeasuredPose& pose, const Eigen::VectorXd& rows) const;
  Eigen::Isometry3d predicted(const CorrectedRobot& robot, std::size_t i) const;

  const DataSet& data_;
  std::vector<std::size_t> poses_;
  std::vector<std::vector<EffectMotion>> motions_;
  double mm_per_rad_;
};

/// Each joint's potential to compensate what is left: the sum over poses of |J_j' left| (thesis eq. 4.11), mm^2 per rad
/// or m.
Eigen::VectorXd compensation_potentials(std::span<const LinearisedPose> poses);

}  // namespace demecal
