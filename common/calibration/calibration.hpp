// A calibration from measured poses to a model: what is done before evolution, and what is done with its results.
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "calibration/job.hpp"
#include "calibration/joint_targets.hpp"
#include "calibration/selection.hpp"
#include "calibration/training.hpp"
#include "data/data_set.hpp"
#include "explanations/error_budget.hpp"
#include "fitting/fit.hpp"
#include "parameters/declared_model.hpp"
#include "parameters/posterior.hpp"
#include "prediction/corrected_robot.hpp"
#include "residuals/residual_field.hpp"

namespace demecal::inline calibration {

/// How a correction's formula came about, as far as that is known: by evolution, as a sum of smooth terms that was
/// fitted to the poses, or as what evolved with such a sum added to it.
enum class FormulaOrigin { unstated, evolved, smooth_terms, evolved_and_smooth_terms };

/// Mean absolute joint error over the calibration poses (thesis Table 6-5), rad.
struct JointSummary {
  int joint = 0;      ///< from 0
  bool kept = false;  ///< whether a correction is in the model
  double before_rad = 0.0;
  double after_rad = 0.0;
  double bound_rad = 0.0;             ///< of the correction over its range
  std::optional<double> limit_rad{};  ///< correction_limit_rad() of a correction that was held back to stay below it
  std::vector<double> discontinuities_rad{};
  std::string note;  ///< why a joint was left neutral; empty where it was not
  FormulaOrigin origin = FormulaOrigin::unstated;
};

/// The word of files; empty where it is not stated.
std::string to_string(FormulaOrigin origin);

/// One summary per joint of `robot`, without notes. `declared`: the joints' errors before anything but the declared
/// numbers was in the model; `now`: what they are of the robot without its corrections. Errors are NaN where there
/// are no targets.
std::vector<JointSummary> joint_summaries(const JointTargets& declared, const JointTargets& now,
                                          const CorrectedRobot& robot);

/// All that stands before the joint corrections are evolved.
struct Preparation {
  CorrectedRobot nominal;               ///< the robot as its maker describes it, in the frame of the data
  Fit registered;                       ///< base fitted, and tool where declared
  Fit declared;                         ///< everything declared but the joint corrections
  JointTargets targets;                 ///< of the calibration poses; empty where no corrections are declared
  std::vector<JointTraining> training;  ///< one per joint that gets islands
  CorrectionOptions corrections;
  TargetOptions target_options{};
};

/// Fits the declared model and computes what the joints should learn. Throws InputError naming the data file where
/// there are too few calibration poses for what is declared or the fit finds no solution.
Preparation prepare(const DataSet& data, const Job& job, const FitOptions& options = {});

/// The same from a model that was found before, on these poses or others: its corrections and effects stay, its
/// declared numbers and the effects' coefficients are fitted again, from wherever the data's frame is. Nothing is made
/// ready for evolution. `model` must have this arm's joints and a tool for every target. Throws InputError as
/// prepare().
Preparation prepare_from(const DataSet& data, const DeclaredModel& declared, const CorrectedRobot& model,
                         const TargetOptions& target_options = {});

/// Where the loop starts: `robot`, its residuals scattering as they do over the calibration poses. Kinds of rows that
/// the fit of the declared model did not use are not used.
Fit loop_start(const DataSet& data, const Fit& declared, const CorrectedRobot& robot);

/// What the joints of the calibration poses without gross errors do beyond `model` without its corrections. Where the
/// preparation wants posterior targets, its corrections are the errors learnt so far.
JointTargets targets_about(const DataSet& data, const Preparation& preparation, const CorrectedRobot& model);

/// What the validation poses said of a model while they were unseen: before the last fit took them in too.
struct UnseenValidation {
  double before_mm = 0.0;         ///< rms, of what the closed loop started from
  double after_mm = 0.0;          ///< rms, of what it ended with
  PredictionInterval interval{};  ///< of what it ended with
  NoiseEstimate noise{};          ///< in the residuals of the fit that had not seen them
};

struct Calibration {
  CorrectedRobot robot;                      ///< the model
  std::vector<ParameterEstimate> estimates;  ///< of the last fit
  std::vector<JointSummary> joints;          ///< one per joint of the arm
  double index_before_mm2 = 0.0;             ///< performance index over the calibration poses: declared model
  double index_after_mm2 = 0.0;              ///< the same of `robot`
  std::optional<UnseenValidation> unseen;    ///< where validation poses had a part in the last fit
  ErrorBudget budget{};                      ///< of the effects that the closed loop found
};

/// Chooses among the evolved candidates on the validation poses (calibration poses where there are none), refits the
/// declared numbers with the corrections in place and keeps the refit where those poses agree.
Calibration conclude(const DataSet& data, const Job& job, const Preparation& preparation,
                     const std::vector<JointCandidates>& candidates, const FitOptions& options = {});

/// The poses of `set` that targets and choices may rest on: without those whose error by `declared` is gross among all
/// poses that calibrate and validate. A pose wrong by metres would decide alone.
std::vector<std::size_t> without_gross_errors(const DataSet& data, PoseSet set, const CorrectedRobot& declared);

/// The poses that select between models: of those that validate or, where there are none, of those that calibrate the
/// ones without gross errors.
std::vector<std::size_t> selection_poses(const DataSet& data, const CorrectedRobot& declared);

/// Performance index (thesis eq. 4.6): the sum of squared tool errors over `poses`, mm^2.
double performance_index_mm2(const CorrectedRobot& robot, const DataSet& data, std::span<const std::size_t> poses);

}  // namespace demecal::inline calibration
