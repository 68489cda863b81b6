// The error of models at the poses of a data set: one model's, as `evaluate` prints it, or several side by side; and
// how far a corrected position may be off, in the words of the GUM (JCGM 100): contributions, standard uncertainty,
// coverage factor, expanded uncertainty.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "closed_calibration/calibrated_model.hpp"
#include "data/data_set.hpp"
#include "parameters/posterior.hpp"
#include "prediction/corrected_robot.hpp"
#include "prediction/measurement.hpp"
#include "report/pose_places.hpp"
#include "report/report.hpp"
#include "trials/finding.hpp"

namespace demecal::inline report {

struct UncertaintyContribution {
  std::string name;
  std::string type;                     ///< "A": from the scatter of measurements; "B": stated by others
  std::optional<double> standard_mm{};  ///< none: not stated
};

/// Of the position of the tool at poses like those it was asked about, measurement noise not included.
struct UncertaintyEntry {
  std::vector<UncertaintyContribution> contributions;
  std::optional<double> standard_mm;      ///< the root of the sum of squares
  std::optional<double> coverage_factor;  ///< 2
  std::optional<double> expanded_mm;      ///< radius that holds about 95 % of positions
  std::string remark;                     ///< where the figures come from
};

/// Over the poses `rows` of `data`, root mean squares. Contributions are scaled so that kCoverageFactor times the
/// standard uncertainty is what `apply` states of targets there (see real_radius95_m()), where the instrument is left
/// out and everything is stated. `instrument_m`: the expanded uncertainty stated for the instrument. Nothing
/// where the model does not state its covariance.
std::optional<UncertaintyEntry> uncertainty_of(const CalibratedModel& model, const DataSet& data,
                                               std::span<const std::size_t> rows, std::optional<double> instrument_m);

SetErrors set_errors(const ErrorFigures& figures);
ErrorBySet errors_by_set(const CorrectedRobot& robot, const DataSet& data);

/// Of the poses `rows`: how many lie outside of what `model` was measured at, by which joints and circumstances, and
/// how far at most, and how many leave unstated what their errors depend on. Empty where there is nothing to say.
std::vector<std::string> widened_sentences(const CalibratedModel& model, const DataSet& data,
                                           std::span<const std::size_t> rows);

/// Of all poses of the data, in their order, by a model that predicts them with `robot` (its own, or the same with
/// another base). `before`: none where it is not known.
std::vector<PoseErrorEntry> pose_errors(const DataSet& data, const CalibratedModel& model, const CorrectedRobot& robot,
                                        const CorrectedRobot* before);

/// Of every contact and set; empty where nothing is touched.
std::vector<ContactEntry> contact_entries(const DataSet& data, const CorrectedRobot& registered,
                                          const CorrectedRobot& before, const CorrectedRobot& after);

/// What these contacts can tell of the arm and what they cannot, the most important first; empty where nothing is
/// touched. `robot`: the model, which has the contacts where its own poses do. `second_place` says what one would add.
std::vector<std::string> contact_notes(const DataSet& data, const CorrectedRobot& robot,
                                       const std::vector<LengthErrorEntry>& lengths,
                                       const std::vector<std::string>& fitted_sets,
                                       const std::string& second_place = {});

/// What as many poses at a second place would add, in mm over the workspace, and to which links most; empty where there
/// are several places, or one contact alone, which gives no figures. `poses` are those that the model was fitted to.
std::string second_place_sentence(const DataSet& data, const CalibratedModel& model,
                                  const std::vector<std::size_t>& poses);

/// Where the radii of poses come from.
PredictionEntry prediction_entry(const PredictionInterval& interval);

/// Whether nothing was measured, and calibration poses touch one contact and no other: what they see of the arm is seen
/// at one place, and the rest, which is believed of its links, was never held against anything.
bool touches_one_contact_alone(const DataSet& data);
/// What calibration on one contact alone cannot see, and that no error over the workspace is predicted from it.
std::string one_contact_sentence();

/// Nothing where the model does not state how sure it is. `placed`: its poses told where the arm stands.
std::optional<WorkspaceEntry> workspace_entry(const CalibratedModel& model, bool placed);
/// The same without figures where the calibration poses of `data` touch one contact alone.
std::optional<WorkspaceEntry> without_figures_of_one_contact(std::optional<WorkspaceEntry> error, const DataSet& data);
/// "0.21 mm rms, 0.4 mm for 95 % ...": the same for people.
std::string workspace_sentence(const WorkspaceEntry& error);

/// How many poses of a set lie within their radius, of how many, and the radii's median, mm.
struct IntervalCoverage {
  std::size_t poses = 0, inside = 0;
  double median_mm = 0.0;
  std::size_t distinct = 0;  ///< repeats and targets of one pose counted once
  double least_radii = 0.0;  ///< the smallest of the errors, each as a multiple of its radius
};
IntervalCoverage coverage_of(const std::vector<PoseErrorEntry>& poses, PoseSet set = PoseSet::accept);
/// Where so few lie within it as chance makes in less than one case of a thousand, or none is nearer than five radii
/// however few there are: what that says. Nothing otherwise.
/// Repeats and targets of one pose count as one pose.
std::string beyond_radii_sentence(const IntervalCoverage& coverage, PoseSet set = PoseSet::accept);
/// The same of the first set of accept, validation and calibration poses that has such a sentence.
std::string beyond_radii_sentence(const std::vector<PoseErrorEntry>& poses);

DataCheckEntry data_check_entry(const DataCheck& check);

/// Whether a finding is of the data set as a whole, so that no model of it means anything.
bool contradicts(const FindingEntry& finding);

/// An effect of the model that some poses lack a circumstance for: there the model predicts as if it were not.
struct UnappliedEffect {
  std::string kind;
  std::optional<std::uint64_t> joint;  ///< from 1; none: of the whole arm
  std::string lacking;                 ///< "approach", "torque", "payload", "temperature" or "time"
  std::size_t poses = 0;               ///< without it
  std::string sentence;  ///< "backlash of joint 2 cannot be applied as it was calibrated at 30 of 30 poses: ..."
};

/// In the order of the model's effects.
std::vector<UnappliedEffect> unapplied_effects(const CorrectedRobot& robot, const DataSet& data);

/// A model on a data set.
struct Evaluation {
  ErrorBySet error_mm;
  std::vector<PoseErrorEntry> pose_errors;  ///< before_mm is none
  DataCheckEntry data_check;
  std::vector<UnappliedEffect> effects_not_applied;
  std::optional<PredictionEntry> prediction;      ///< for people alone
  std::optional<UncertaintyEntry> uncertainty{};  ///< of a corrected position at poses like these
  std::string beyond_radii{};                     ///< where poses do not keep to their radii; then no uncertainty
  std::vector<std::string> widened_by{};          ///< see widened_sentences(), of all poses
  /// For people alone, in its place where poses only touch something: they agree with means of their own, which tells
  /// nothing of where the tool is.
  std::optional<WorkspaceEntry> workspace_error{};
  std::vector<LengthErrorEntry> length_errors{};
  bool of_one_contact = false;  ///< the model; then no workspace_error
  bool touches = false;         ///< whether the poses touch anything: then lengths are listed
  /// Nothing where no pose has a measured one.
  std::optional<bool> orientations_judged{};
};

/// {"error_mm": {"calibration": {mean, rms, p95, max}, "validation": ..., "accept": ...}, "pose_errors": [...],
/// "data_check": ..., "effects_not_applied": [...], "uncertainty": ..., "beyond_radii": ...} on one line.
std::string to_json(const Evaluation& evaluation);

struct ComparedMethod {
  std::string key, title;
  int parameters = 0;  ///< numbers identified
  double wall_s = 0.0;
  std::string chosen;  ///< by cross-validation, or why there are no figures
  ErrorBySet error_mm;
};

/// What several methods make of the same poses.
struct Comparison {
  std::string job, robot, data, data_sha256;
  std::array<std::size_t, 3> poses{};  ///< of calibration, validation, accept
  std::vector<ComparedMethod> methods;
};

/// {"demecal_comparison": 1, ..., "methods": [{"method", "title", "parameters", "wall_s", "chosen", "error_mm"}]}, on
/// one line, or with an indent where that is not negative; figures that do not exist are null.
std::string to_json(const Comparison& comparison, int indent = -1);

}  // namespace demecal::inline report
