// What a calibration leaves to be used: the model, where it came from, how surely its numbers are known, and how far
// its predictions err.
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <numbers>
#include <optional>
#include <string>
#include <vector>

#include "calibration/calibration.hpp"
#include "calibration/evolver.hpp"
#include "calibration/job.hpp"
#include "data/certificate_fields.hpp"
#include "data/data_set.hpp"
#include "expression/bound.hpp"
#include "fitting/fit.hpp"
#include "parameters/declared_model.hpp"
#include "parameters/observation.hpp"
#include "parameters/posterior.hpp"
#include "parameters/widening.hpp"
#include "prediction/corrected_robot.hpp"

namespace demecal::inline closed_calibration {

/// A robot whose model is one of those that a fleet's was made from.
struct FleetMember {
  std::string file, job, data_name, data_sha256;
};

/// What the robots of a fleet have in one number, in the unit that its name states (of an effect's: SI).
struct FleetNumber {
  std::string name;
  double mean = 0.0, standard_error = 0.0;  ///< of the type
  double spread = 0.0;                      ///< standard deviation of the robots about it
};

/// How the robots' corrections of one joint differ from their mean.
struct FleetCurve {
  int joint = 0;                            ///< from 0
  std::vector<double> wave_deviations_rad;  ///< of a cosine or sine of 1, 2, ... cycles a turn
};

/// What a model that is the mean of several robots of one type states besides.
struct FleetOrigin {
  std::vector<FleetMember> robots;
  std::vector<FleetNumber> numbers;
  std::vector<FleetCurve> curves;
};

/// The steps of a joint's turn that CalibratedModel::pose_counts counts poses in.
inline constexpr int kTurnSteps = 72;
inline constexpr double kTurnStep_rad = 2.0 * std::numbers::pi / kTurnSteps;

struct CalibratedModel {
  std::string job;
  Robot nominal;  ///< the robot as its maker describes it
  Method method = Method::direct;
  DeclaredModel declared;
  CorrectedRobot robot;
  std::vector<ParameterEstimate> estimates;
  std::vector<JointSummary> joints;
  std::optional<Posterior> posterior{};          ///< nothing in models of old versions
  std::optional<PredictionInterval> interval{};  ///< nothing in models of old versions
  std::vector<Interval> measured{};  ///< of every joint, where it stood in the fitted poses; none in old models
  std::map<int, std::vector<Interval>> measured_gaps{};  ///< of joints, from 0: where inside that none of them stood
  /// That formulas of several joints share; nothing where the job did not ask for any, none where none was found.
  KnownFunctions functions{};
  /// Of revolute joints, from 0: how many of the fitted poses stand in each kTurnStep_rad of a turn, from 0 on. Nothing
  /// in models of old versions and of fleets.
  std::map<int, std::vector<int>> pose_counts{};
  /// pose_marks() of the poses that it learnt from or was chosen by; none in models of old versions.
  std::vector<std::uint64_t> pose_marks{};
  CertificateFields certificate{};  ///< what the job states for certificates
  std::vector<Station> stations{};  ///< where the data were measured from; empty: one place
  /// Of the mean of several robots of one type, whose posterior says how far one of them may be from it; such a model
  /// has no base and the tool of the drawing.
  std::optional<FleetOrigin> fleet{};
  std::string data_name;
  std::string data_sha256;
  std::vector<std::string> data_findings{};  ///< kinds of findings of the data check; none in models of old versions
  bool of_one_contact = false;               ///< nothing was measured, and all calibration poses touch one contact
  bool approach_recorded = true;  ///< the data state the sides that joints came from; true in models of old versions
  std::uint64_t seed = 0;
  std::string version;
};

/// The step of a turn that an angle is in, whole turns aside.
std::size_t turn_step(double angle_rad);

/// By how much radii are larger at a stop than where the model was measured.
Widening widening_at(const CalibratedModel& model, const Stop& stop);
/// Whether they are clearly larger there, by where the stop is: `there_by` is widening_at() it.
bool is_outside_measured(const CalibratedModel& model, const Stop& stop, const Widening& there_by);

/// The covariance of the model's numbers over the poses it was fitted to: of base, links, tools and effects, and of
/// what smooth terms could still change in corrections that are declared. Along what the poses do not show it is as
/// wide as makers' figures are uncertain (FitOptions), 10 mm and 0.1 rad for tools.
Posterior posterior_of(const DataSet& data, const DeclaredModel& declared, const Calibration& calibration);

/// The posterior of a robot that was fitted to `poses`, and how far their rows scatter about it (standard deviations
/// for the degrees of freedom that the model leaves; m, rad, m). Errors that the residuals show to be shared, by
/// repeats of a pose or neighbours in time, count as shared; `known` is that noise where an earlier fit showed it.
struct FittedPosterior {
  Posterior posterior;
  RowScales scatter{};
  /// Of the positions' scatter what joints have in it: the arm's own, no instrument's. 0 where it is less than half.
  double arm_scatter_m = 0.0;
  NoiseEstimate noise{};
};
FittedPosterior fitted_posterior(const DataSet& data, const DeclaredModel& declared, const CorrectedRobot& robot,
                                 const std::vector<std::size_t>& poses,
                                 const std::optional<NoiseEstimate>& known = std::nullopt);

/// The lowest and highest value (rad or m) of every joint over the same poses.
std::vector<Interval> measured_ranges(const DataSet& data, const Calibration& calibration);

/// Inside these the stretches (rad or m) of joints, from 0, in which none of the poses stands, of 20 deg (100 mm) or
/// more, where as many different values drawn at random would leave one so wide in fewer than one of a hundred cases.
std::map<int, std::vector<Interval>> measured_gaps(const DataSet& data, const Calibration& calibration);

/// Of the calibration and validation poses the kPoseMarks smallest hashes of joints and of what was measured there,
/// ascending: a fair sample of them, by which they are known again in whatever file they stand.
std::vector<std::uint64_t> pose_marks(const DataSet& data);
inline constexpr std::size_t kPoseMarks = 32;
/// The smallest of two such samples together.
std::vector<std::uint64_t> marks_of_both(const std::vector<std::uint64_t>& one,
                                         const std::vector<std::uint64_t>& other);
/// The poses of the data that are among the model's marked ones, whatever set they are of; ascending.
std::vector<std::size_t> marked_poses(const CalibratedModel& model, const DataSet& data);

/// How often revolute joints stand where in their turn, over the same poses.
std::map<int, std::vector<int>> pose_counts(const DataSet& data, const Calibration& calibration);

/// Whether most poses were measured near the one before them, as along a path: their median step, of the joint that
/// moves most, is less than a quarter of what the poses cover (random ones go over two thirds of it). Repeats are no
/// steps.
bool follow_each_other(const DataSet& data);

/// From the validation poses, which must be unseen by the fit that `fitted` (of `robot`) comes from: split conformal
/// prediction of scores |error| / deviation, the deviation that of posterior, noise and model error together. Poses are
/// exchangeable but for repeats: those of one id share one vote. Scores beyond ten times their median are gross errors,
/// and left out. With fewer than 19 distinct poses the quantile is that of normal errors. Without validation poses the
/// calibration poses tell, as far as the fit left their errors visible.
PredictionInterval prediction_interval(const DataSet& data, const FittedPosterior& fitted, const CorrectedRobot& robot);

/// Of a finished calibration: from the validation poses while they were unseen.
PredictionInterval interval_of(const DataSet& data, const DeclaredModel& declared, const Calibration& calibration);

}  // namespace demecal::inline closed_calibration
