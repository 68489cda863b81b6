// A calibration from measured poses to a model: what is done before evolution, and what is done with its results.
#pragma once

#include <string>
#include <vector>

#include "calibration/job.hpp"
#include "calibration/selection.hpp"
#include "calibration/training.hpp"
#include "fitting/fit.hpp"

namespace demecal {

/// All that stands before the joint corrections are evolved.
struct Preparation {
  CorrectedRobot nominal;               ///< the robot as its maker describes it, in the frame of the data
  Fit registered;                       ///< base fitted, and tool where declared
  Fit declared;                         ///< everything declared but the joint corrections
  JointTargets targets;                 ///< of the calibration poses; empty where no corrections are declared
  std::vector<JointTraining> training;  ///< one per joint that gets islands
};

/// Fits the declared model and computes what the joints should learn. Throws InputError naming the data file where
/// there are too few calibration poses for what is declared or the fit finds no solution.
Preparation prepare(const DataSet& data, const Job& job, const FitOptions& options = {});

/// Mean absolute joint error over the calibration poses (thesis Table 6-5), rad.
struct JointSummary {
  int joint = 0;      ///< from 0
  bool kept = false;  ///< whether a correction is in the model
  double before_rad = 0.0;
  double after_rad = 0.0;
  double bound_rad = 0.0;  ///< of the correction over its range
  std::vector<double> discontinuities_rad{};
  std::string note;  ///< why a joint was left neutral; empty where it was not
};

struct Calibration {
  CorrectedRobot robot;                      ///< the model
  std::vector<ParameterEstimate> estimates;  ///< of the last fit
  std::vector<JointSummary> joints;          ///< one per joint of the arm
  double index_before_mm2 = 0.0;  ///< performance index (thesis eq. 4.6) over the calibration poses: declared model
  double index_after_mm2 = 0.0;   ///< and with the corrections
};

/// Chooses among the evolved candidates on the validation poses (calibration poses where there are none), refits the
/// declared numbers with the corrections in place and keeps the refit where those poses agree.
Calibration conclude(const DataSet& data, const Job& job, const Preparation& preparation,
                     const std::vector<JointCandidates>& candidates, const FitOptions& options = {});

}  // namespace demecal
