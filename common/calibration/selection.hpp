// Which of the evolved corrections the model keeps: those that reduce the error of poses that had no part in evolution.
#pragma once

#include <algorithm>
#include <cstddef>
#include <span>
#include <vector>

#include "calibration/training.hpp"
#include "data/data_set.hpp"
#include "evolution/population.hpp"
#include "expression/tree.hpp"
#include "fitness/parameters.hpp"
#include "kinematics/chain.hpp"
#include "prediction/corrected_robot.hpp"
#include "prediction/measurement.hpp"

namespace demecal::inline calibration {

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
class PoseEvaluator {
 public:
  PoseEvaluator(const DataSet& data, std::span<const std::size_t> poses, const CorrectedRobot& robot);

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

/// The evolved candidates of one joint: best of each length, gathered over its islands.
struct JointCandidates {
  JointTraining training;
  Population front;
  std::vector<Tree> short_forms{};              ///< what the front comes to, written down briefly
  std::vector<JointCorrection> alternatives{};  ///< corrections from elsewhere, the same place of every joint's
                                                ///< belonging together
};

/// What became of one joint's candidates.
struct JointChoice {
  int joint = 0;      ///< from 0
  bool kept = false;  ///< false: left neutral
  std::size_t candidates = 0;
  double gain_mm2 = 0.0;        ///< fall of the mean squared tool error on the selection poses when it was chosen
  double gain_error_mm2 = 0.0;  ///< standard error of that fall
};

struct Selection {
  CorrectedRobot robot;
  std::vector<JointChoice> choices;  ///< one per candidate list, in its order
};

/// Fills in the front's short forms: simplified, and with constants fitted to the training by least squares.
void add_short_forms(JointCandidates& candidates, const GpParameters& parameters);

/// Whether interval arithmetic holds a correction within its limit (see correction_limit_rad) over its range. What is
/// not (a pole, most often) is not considered (thesis 6.2.2).
bool is_bounded(const JointCorrection& correction, const JointTraining& training);

/// Joint by joint, in sweeps until nothing changes: once from all joints neutral, once from all joints with what fits
/// their own targets best (the targets of a pose belong together), and once from every set of corrections from
/// elsewhere, which is then a candidate too; whichever ends best. Of a joint's candidates, with the other joints as
/// they stand, that is taken which, with the tool errors it leaves at the `selecting` poses, is described in the fewest
/// nats (see description_length_nats); where joints learnt together (tables of squared errors) the shortest that is at
/// most half a standard error worse than the best. It is kept only if it beats the neutral correction by more than two
/// standard errors on these poses and on the `fitted` ones too, and the whole never does worse on the selection poses
/// than no correction. A candidate that is not bounded is not considered. `selecting` holds validation poses; the
/// calibration poses where there are none.
Selection select_corrections(const DataSet& data, std::span<const std::size_t> fitted,
                             std::span<const std::size_t> selecting, const CorrectedRobot& declared,
                             std::span<const JointCandidates> candidates);

}  // namespace demecal::inline calibration
