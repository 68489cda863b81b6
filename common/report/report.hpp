// The document of a run: every figure, sentence and formula that report.json holds and that people are shown.
#pragma once

#include <cmath>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "expression/bound.hpp"
#include "report/left_error.hpp"
#include "report/pose_places.hpp"

namespace demecal::inline report {

// Members are in the order of report.json and in the units of its keys. What may be absent there is optional here, and
// so is a number that may not be finite: JSON knows none. Joints count from 1.

/// Nothing where it is not finite.
inline std::optional<double> if_finite(double value) {
  return std::isfinite(value) ? std::optional(value) : std::nullopt;
}

/// The tool error over a set of poses; nothing where the set is empty.
struct SetErrors {
  std::optional<double> mean_mm, rms_mm, p95_mm, max_mm;
};

struct ErrorBySet {
  SetErrors calibration, validation, accept;
};

struct BeforeAfter {
  std::optional<double> before, after;
};

/// A mistake in the data, or what looks like one.
struct FindingEntry {
  std::string kind;  ///< see FindingKind
  std::uint64_t joint = 0;
  std::vector<std::string> poses;
  std::optional<double> as_given_mm, if_changed_mm;
  std::string sentence;
};

struct DataCheckEntry {
  std::string verdict;
  std::vector<FindingEntry> findings;
};

/// A pose that the data set leaves out by name.
struct ExcludedPose {
  std::string id, set;
  std::optional<double> error_mm;  ///< of the final model at it
};

/// What the radii of single poses come from.
struct PredictionEntry {
  std::optional<double> quantile, noise_mm, distance_noise_mm, model_error_mm;
  std::string pose_set;  ///< the set of poses
  std::uint64_t poses = 0, gross_errors = 0;
  std::string remark;
};

/// The error of the robot's own tool that is predicted over the joints' measured ranges, measurement noise left out.
struct WorkspaceEntry {
  std::optional<double> rms_mm, p95_mm;
  bool beside_base =
      false;  ///< once the arm as a whole is shifted and turned to fit best: nothing told where it stands
};

struct NamedNumber {
  std::string name;  ///< with its unit
  std::optional<double> value;
};

/// One effect: its place, its numbers by name, and how large it is.
struct EffectEntry {
  std::string kind;                          ///< a word of the catalogue; empty: no effect
  std::optional<std::uint64_t> joint;        ///< none: of the whole arm or of the instrument
  std::string form;                          ///< of the law, where it has several
  std::vector<NamedNumber> parameters;       ///< settings, then coefficients where they have values; SI
  std::vector<NamedNumber> standard_errors;  ///< of coefficients, where known
  std::optional<double> amplitude;           ///< its one coefficient, or the size of all that have its unit
  std::string unit;                          ///< of the amplitude; empty where it has no values

  std::optional<double> parameter(const std::string& wanted) const;
  std::optional<double> standard_error(const std::string& wanted) const;
  /// "ratio 24": form and settings that tell it from others of its kind and joint; empty where there are none.
  std::string distinction() const;
  /// "gear_harmonic (ratio 24), joint 2".
  std::string name() const;
  /// The same with the masses that it is of, where these are unknown: "compliance (moments of links 2 to 7), joint 2".
  std::string full_name() const;
  /// "0.412 mrad"; empty where it has no values.
  std::string size() const;
};

struct RivalEntry {
  EffectEntry effect;
  std::optional<double> cosine, nats_behind;
};

struct ClassMember {
  std::string kind;
  std::optional<std::uint64_t> joint;
};

struct NamedInterval {
  std::string name;
  std::optional<double> lower, upper;
};

struct NextMeasurementEntry {
  std::string sentence;
  std::uint64_t poses = 0;
};

/// One round of the closed loop; see Round.
struct RoundEntry {
  std::uint64_t round = 0, group = 0;
  std::string verdict;  ///< "added", "rejected", "none"
  EffectEntry effect;
  std::string diagnosis, formula, reason;
  bool implausible = false;
  std::vector<ClassMember> members;  ///< `class` in JSON: the effect and those that these poses cannot tell from it
  std::string class_sentence;
  std::vector<RivalEntry> rivals;
  std::optional<double> p_structure, p_family;
  std::uint64_t null_draws = 0;
  std::optional<double> gain_nats, confirmed, confirmed_lower, sign_stability;
  std::vector<NamedInterval> interval;
  std::optional<double> validation_before_mm, validation_after_mm;
  std::optional<NextMeasurementEntry> next_measurement;

  bool added() const { return verdict == "added"; }
};

/// What an engineer counts as one cause; see CauseCost.
struct CauseEntry {
  std::string cause;  ///< "transmission", "lost_motion", ...
  std::optional<std::uint64_t> joint;
  std::string name;                  ///< for people: "gears of joint 2"
  std::vector<std::string> effects;  ///< as EffectEntry::name() has them
  std::optional<double> without_mm, with_mm, share_of_error;
  std::vector<double> interval_mm;  ///< lower and upper end
  std::string advice;
  std::vector<std::string> alternatives{};  ///< names of causes that these poses cannot tell it from

  /// What it costs beside all others: the root of the fall of the mean square.
  double cost_mm() const {
    const double with = with_mm.value_or(0.0), without = without_mm.value_or(0.0);
    return without > with ? std::sqrt(without * without - with * with) : 0.0;
  }
};

/// The best model of so many causes; see FrontPoint.
struct FrontEntry {
  std::uint64_t causes = 0;
  std::optional<double> validation_rms_mm, accept_rms_mm;
  bool chosen = false;
};

/// An effect that was looked for and not found; see NotFound.
struct NotFoundEntry {
  EffectEntry effect;  ///< without its size
  std::optional<double> smallest_detectable;
  std::string unit;
  std::string sentence;  ///< why these data tell nothing of it; empty where they do

  bool testable() const { return sentence.empty(); }
};

struct UntestableEntry {
  std::string kind, reason;
};

struct DecoyEntry {
  std::string name;
  std::optional<double> best_gain_nats, p_left;
  bool won = false;
};

/// The errors of the poses that one station measured.
struct StationEntry {
  std::string name;
  std::uint64_t poses = 0;
  ErrorBySet registered, before, after;
  std::optional<double> noise_mm, noise_floor_mm;  ///< per axis: of fitted poses about the model (median), of repeats
};

struct JointEntry {
  std::uint64_t joint = 0;
  bool kept = false;  ///< whether the model corrects it
  std::string expression;
  BeforeAfter mean_abs_error_rad;
  std::optional<Interval> range_rad;
  std::optional<double> bound_rad;
  std::optional<double> limit_rad;          ///< of a correction that was held back to stay below it
  std::vector<double> discontinuities_rad;  ///< ascending
  std::string with_functions;               ///< the expression with calls of functions that joints share
  std::string note;                         ///< why it is not corrected
  std::string origin;                       ///< "evolved", "smooth_terms", "evolved_and_smooth_terms"; empty: not known
  std::string short_form;                   ///< "0.31 mrad sin(q2 + 14 deg)", where such a formula does as well
  std::string as_evolved;                   ///< what fits the joint's targets best; empty where nothing evolved
  std::optional<double> as_evolved_error_rad;  ///< mean absolute, that it leaves of them
};

struct SharedFunctionEntry {
  std::string definition;  ///< F1(c1, a1) = c1 * SIN(a1)
  std::vector<std::uint64_t> joints;
};

/// A step of distal learning (thesis Table 4-1).
struct DistalEntry {
  std::uint64_t joint = 0, generation = 0;
  std::string expression;
  std::optional<double> index_mm2;
};

/// In the unit that its name ends with.
struct ParameterEntry {
  std::string name;
  std::optional<double> nominal, value, standard_error;
};

struct WaitingEntry {
  std::string worker;
  std::optional<double> share;
};

struct RuntimeEntry {
  std::optional<double> wall_s;
  std::optional<std::uint64_t> workers, islands, generations, evaluations, migrations, evolved_sets, dropped_samples;
  bool interrupted = false;
  bool asynchronous = false;  ///< islands waited for no neighbour: the result depends on timing
  bool resumed = false;
  std::vector<WaitingEntry> waited_share;
};

struct Report {
  std::string job, robot, method;
  std::optional<std::uint64_t> seed;
  std::string data_sha256, version;
  DataCheckEntry data_check;  ///< before and after the fit
  struct Poses {
    std::uint64_t calibration = 0, validation = 0, accept = 0;
    std::vector<std::string> outliers;  ///< pose ids: of the loop's last fit; without it, of the declared fit
    std::vector<ExcludedPose> excluded;
    std::vector<std::string> near_singular;  ///< pose ids, down-weighted
  } poses;
  ErrorBySet nominal;                                    ///< the uncalibrated robot in the frame the data came in
  ErrorBySet registered;                                 ///< after the best-fit base, and tool where declared
  ErrorBySet declared;                                   ///< after everything declared but the joint corrections
  ErrorBySet as_evolved;                                 ///< the declared model with what every joint evolved
  ErrorBySet before;                                     ///< after everything declared
  ErrorBySet after;                                      ///< with the effects that the closed loop added
  std::vector<std::string> fitted_sets;                  ///< `last_fit.poses`
  std::optional<BeforeAfter> unseen_validation_rms_mm;   ///< where validation poses had a part in the last fit
  std::vector<StationEntry> stations{};                  ///< where the data are of several
  std::vector<PoseErrorEntry> pose_errors;               ///< of all poses; empty where nothing was fitted
  std::optional<ArmEntry> arm{};                         ///< where something was fitted
  std::vector<LengthErrorEntry> length_errors{};         ///< of known lengths between contacts
  std::vector<ContactEntry> contacts{};                  ///< where poses touch something
  std::vector<std::string> contact_notes{};              ///< what contacts can and cannot tell: sentences
  std::optional<PredictionEntry> prediction_interval{};  ///< behind their radii
  std::optional<WorkspaceEntry> workspace_error{};       ///< of models that state how sure they are
  std::optional<double> noise_floor_mm;  ///< standard deviation of repeats per axis, where there are repeats
  std::vector<CauseEntry> causes;        ///< of what the loop added, the costliest first
  std::vector<FrontEntry> front;         ///< from no cause to all
  std::optional<UnexplainedEntry> unexplained{};
  std::vector<RoundEntry> rounds;
  std::vector<EffectEntry> dropped;  ///< added, and taken back
  std::vector<NotFoundEntry> not_found;
  std::vector<UntestableEntry> untestable;
  std::vector<std::string> considered{};  ///< kinds, where not all of the catalogue were
  std::vector<DecoyEntry> decoys;
  std::string stopped = "not_run";
  std::optional<double> lack_of_fit_p, explained_share, structure_left_p;
  std::optional<NoiseEntry> noise;
  std::uint64_t candidates = 0, null_draws = 0;
  BeforeAfter performance_index_mm2;
  std::vector<JointEntry> joints;
  std::optional<std::vector<SharedFunctionEntry>> shared_functions;  ///< where the job asked for any
  std::optional<std::vector<DistalEntry>> distal;                    ///< of distal learning, before the loop
  std::vector<ParameterEntry> parameters;
  std::vector<std::string> unidentified;  ///< sentences
  RuntimeEntry runtime;
  bool loop_ran() const { return !stopped.empty() && stopped != "not_run"; }
  bool added_any() const;
};

/// Indented JSON with `demecal_report: 1`; numbers that do not exist are null.
std::string to_json(const Report& report);

/// What to_json() wrote, `demecal_report: 1` at least. Throws InputError naming `file` and the value that is wrong.
Report read_report(const std::string& text, const std::string& file);

}  // namespace demecal::inline report
