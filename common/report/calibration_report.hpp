// What a calibration did to the error, and why: the figures that people and programs read.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "calibration/calibrated_model.hpp"
#include "calibration/distal_steps.hpp"
#include "data_check/finding.hpp"
#include "diagnosis/outcome.hpp"
#include "effects/measurement.hpp"
#include "report/pose_errors.hpp"
#include "structure/found_transform.hpp"

namespace demecal {

/// The four figures on each set of poses; NaN where a set is empty.
struct ErrorBySet {
  ErrorFigures calibration, validation, accept;
};
ErrorBySet errors_by_set(const CorrectedRobot& robot, const DataSet& data);

struct RunFacts {
  double wall_s = 0.0;
  std::size_t workers = 0;
  std::size_t islands = 0;
  std::uint64_t generations = 0;
  std::uint64_t evaluations = 0;
  std::uint64_t migrations = 0;
  bool interrupted = false;
  bool asynchronous = false;          ///< islands waited for no neighbour: the result depends on timing
  std::uint64_t dropped_samples = 0;  ///< of the network, not acted on since they could not be believed
  bool resumed = false;               ///< part of it comes from a journal; wall_s and workers are of the last process
  std::map<std::string, double> waited_share;  ///< of each worker: of its slots' time while it had islands to breed,
                                               ///< the share without work
};

struct PoseCounts {
  std::size_t calibration = 0, validation = 0, accept = 0;
};

/// One line of the joints' table.
struct JointLine {
  JointSummary summary;
  std::string expression;  ///< g(theta) in rad, the thesis's notation
  Interval range_rad;
  std::string with_functions{};  ///< the expression with calls of functions that joints share; empty without any
};

/// A function that joints share.
struct SharedFunctionLine {
  std::string definition;   ///< F1(c1, a1) = c1 * SIN(a1)
  std::vector<int> joints;  ///< from 0: those whose corrections call it
};

/// A pose that the data set leaves out by name.
struct ExcludedPose {
  std::string id, set;
  double error_mm = 0.0;  ///< of the final model at it
};

struct CalibrationReport {
  DataCheck check;  ///< of the data, before and after the fit
  std::vector<ExcludedPose> excluded;
  std::string job, robot, method, data_sha256, version;
  std::uint64_t seed = 0;
  PoseCounts poses;
  std::vector<std::string> outliers;           ///< pose ids: of the loop's last fit; without it, of the declared fit
  std::vector<std::string> near_singular;      ///< pose ids, down-weighted
  ErrorBySet nominal;                          ///< the uncalibrated robot in the frame the data came in
  ErrorBySet registered;                       ///< after the best-fit base, and tool where declared
  ErrorBySet declared;                         ///< after everything declared but the joint corrections
  ErrorBySet before;                           ///< after everything declared
  ErrorBySet after;                            ///< with the effects that the closed loop added
  std::optional<double> noise_floor_mm;        ///< standard deviation of repeats per axis, where there are repeats
  std::optional<UnseenValidation> unseen;      ///< where validation poses had a part in the last fit
  std::vector<PoseErrorLine> pose_errors;      ///< of all poses; empty where nothing was fitted
  std::optional<PredictionInterval> interval;  ///< behind their radii
  LoopOutcome loop;
  Robot described;  ///< the arm as its maker describes it, by which the loop's effects stand
  double index_before_mm2 = 0.0, index_after_mm2 = 0.0;
  std::vector<JointLine> joints;
  std::optional<std::vector<SharedFunctionLine>> functions;  ///< where the job asked for any
  std::vector<DistalStep> distal;         ///< the course of distal learning before the loop (thesis Table 4-1)
  std::vector<FoundTransform> structure;  ///< of the structural method: what stands between the links
  std::vector<ParameterEstimate> estimates;
  std::vector<std::string> unidentified;  ///< sentences
  RunFacts runtime;
};

/// All figures of a finished calibration. `model` is what was written to the model file, so that evaluating that file
/// gives the same figures; `before` is the robot that the closed loop started from, and `loop` what it made of it.
CalibrationReport make_report(const DataSet& data, const CalibratedModel& model, const CorrectedRobot& before,
                              const LoopOutcome& loop, const Preparation& preparation, const Calibration& calibration,
                              const RunFacts& runtime);

/// The standard deviation per axis of position about the mean of its repeats, mm; nothing where no pose is repeated.
std::optional<double> noise_floor_mm(const DataSet& data);

/// The report of data that contradict the robot: what was found, the errors of the nominal robot, and nothing fitted.
CalibrationReport refusal_report(const DataSet& data, const std::string& job, const DataCheck& check);

}  // namespace demecal
