// The tables a job's islands learn from, and the way back from what they evolve to a correction in radians.
#pragma once

#include <cstdint>
#include <limits>
#include <vector>

#include "calibration/job.hpp"
#include "calibration/joint_targets.hpp"
#include "expression/bound.hpp"
#include "expression/tree.hpp"
#include "fitness/fitness.hpp"
#include "kinematics/angles.hpp"
#include "kinematics/chain.hpp"
#include "prediction/corrected_robot.hpp"

namespace demecal::inline calibration {

/// One joint's table: theta (rad) as variable 0, theta_C - theta_N in units of scale_rad as target.
struct JointTraining {
  std::uint32_t joint = 0;  ///< from 0
  TrainingTable table;
  /// 1, 2 or 5 times a power of ten: the largest that the mean absolute target reaches. Where distal learning fitted
  /// the amplitude of the joint's correction, that.
  double scale_rad = 1.0;
  Interval range_rad;  ///< of theta in the table
  AngleBranch branch;
  double largest_rad = std::numeric_limits<double>::infinity();  ///< that the user allows the correction to become
};

/// Tables of every revolute joint that moves over the targets' poses by more than 1 mrad; the others stay neutral.
/// Formulas are limited by correction_limit_rad(); those of `options` that are for the joint are the tables' seeds.
std::vector<JointTraining> training_tables(const Chain& chain, const JointTargets& targets,
                                           const CorrectionOptions& options = {});

/// The formulas that are for the training's joint, in units of its scale: what correction_from() makes the same
/// corrections of.
std::vector<Tree> seed_trees(const std::vector<SeedFormula>& seeds, const JointTraining& training);

/// The largest 1, 2 or 5 times a power of ten that `mean_absolute` reaches, at least 1e-12.
double round_scale(double mean_absolute);

/// The evolved tree times the scale, over the joint's calibrated range: g(theta) in rad.
JointCorrection correction_from(const JointTraining& training, const Tree& evolved);
/// The tree that correction_from() made a correction of.
Tree evolved_tree(const JointCorrection& correction);
/// The scale that correction_from() made it with, rad.
double evolved_scale_rad(const JointCorrection& correction);

/// Three times the size of target errors that one row in twenty exceeds, but at most `largest_rad` of the training.
/// Over rows of full weight; in tables of squared errors, over those that count no less than the median one.
double correction_limit_rad(const JointTraining& training);

/// Sets the limit of the training's table, from which islands know what to refuse.
void limit_formulas(JointTraining& training);

/// The correction with its formula simplified and its terms collected, as far as that keeps its values to 1e-9 of the
/// largest over its range (see simplified_over).
JointCorrection shortened(const JointCorrection& correction);

/// The robot with all its corrections shortened.
CorrectedRobot with_shortened_corrections(CorrectedRobot robot);

/// Whether any joint's correction is not neutral.
bool has_corrections(const CorrectedRobot& robot);

/// The robot with all its corrections neutral.
CorrectedRobot without_corrections(CorrectedRobot robot);

}  // namespace demecal::inline calibration
