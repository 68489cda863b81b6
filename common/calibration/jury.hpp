// Poses that are asked how well a model predicts them, again and again with other corrections.
#pragma once

#include <span>
#include <vector>

#include "effects/corrected_robot.hpp"
#include "effects/measurement.hpp"

namespace demecal {

using SquaredErrors = std::vector<double>;  ///< mm^2, one per pose

/// The fall of an error, pose by pose.
struct PairedDifference {
  double mean = 0.0;            ///< mm^2
  double standard_error = 0.0;  ///< infinite for fewer than two poses
};
PairedDifference paired(const SquaredErrors& worse, const SquaredErrors& better);

double sum(const SquaredErrors& errors);

/// `poses` of `data`, with what the effects of a robot do at each of them kept ready: corrections may change, all else
/// of the robot stays.
class Jury {
 public:
  Jury(const DataSet& data, std::span<const std::size_t> poses, const CorrectedRobot& robot);

  /// Measured numbers that have a part in tool errors.
  double rows() const { return rows_; }

  /// Joints after the robot's corrections, one vector per pose.
  std::vector<JointVector> corrected(const CorrectedRobot& robot) const;
  /// The same joints with `correction` alone at `joint` (from 0).
  std::vector<JointVector> with(std::vector<JointVector> corrected, std::size_t joint,
                                const JointCorrection& correction) const;

  /// Squared tool errors at joints already corrected; poses that measured orientation only do not count.
  SquaredErrors squared_errors(const CorrectedRobot& robot, const std::vector<JointVector>& corrected) const;
  SquaredErrors squared_errors(const CorrectedRobot& robot) const { return squared_errors(robot, corrected(robot)); }

 private:
  const DataSet& data_;
  std::vector<std::size_t> poses_;
  double rows_ = 0.0;
  std::vector<std::vector<EffectMotion>> motions_;
};

}  // namespace demecal
