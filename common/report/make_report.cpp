#include "report/make_report.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <ranges>
#include <string_view>

#include "calibration/admissible.hpp"
#include "calibration/calibration.hpp"
#include "calibration/evolver.hpp"
#include "calibration/job.hpp"
#include "calibration/joint_targets.hpp"
#include "calibration/shared_functions.hpp"
#include "calibration/training.hpp"
#include "diagnosis/loop.hpp"
#include "expression/bound.hpp"
#include "expression/shared_function.hpp"
#include "expression/text.hpp"
#include "kinematics/units.hpp"
#include "parameters/declared_model.hpp"
#include "prediction/measurement.hpp"
#include "report/evaluation.hpp"
#include "report/length_entries.hpp"
#include "residuals/structure.hpp"

namespace demecal::inline report {
namespace {

std::vector<std::string> ids(const DataSet& data, const std::vector<std::size_t>& poses) {
  std::vector<std::string> names;
  for (const std::size_t pose : poses) {
    const std::string& name = data.poses[pose].pose_id;
    if (std::ranges::find(names, name) == names.end()) names.push_back(name);
  }
  return names;
}

Report::Poses counts_of(const DataSet& data) {
  Report::Poses poses;
  poses.calibration = poses_of(data, PoseSet::calibration).size();
  poses.validation = poses_of(data, PoseSet::validation).size();
  poses.accept = poses_of(data, PoseSet::accept).size();
  return poses;
}

/// Those that the fit found, and those of every set that are far out by the model.
std::vector<std::size_t> outliers_of(const Conclusions& run) {
  constexpr double kSmallest_m = 1e-6;  ///< exact data have rounding errors alone
  const DataSet& data = run.data;
  const bool looped = run.loop.stopped != StopReason::not_run;
  std::vector<std::size_t> outliers = looped ? run.loop.outliers : run.preparation.declared.outliers;
  for (const PoseSet set : {PoseSet::calibration, PoseSet::validation, PoseSet::accept}) {
    const std::vector<std::size_t> poses = poses_of(data, set);
    std::vector<double> errors_m;
    for (const std::size_t pose : poses) errors_m.push_back(tool_error_m(run.model.robot, data, data.poses[pose]));
    const double limit_m = std::max(kSmallest_m, gross_error_limit(errors_m));
    for (std::size_t i = 0; i < poses.size(); ++i)
      if (errors_m[i] > limit_m) outliers.push_back(poses[i]);
  }
  return outliers;
}

Report::Poses named_poses(const Conclusions& run) {
  const DataSet& data = run.data;
  Report::Poses poses = counts_of(data);
  poses.outliers = ids(data, outliers_of(run));
  const CorrectedRobot placed = with_own_contacts(run.model.robot, data);
  for (const MeasuredPose& pose : data.excluded) {
    poses.excluded.push_back(
        {pose.pose_id, std::string(to_string(pose.set)), if_finite(millimetres(tool_error_m(placed, data, pose)))});
  }
  for (const SingularPose& singular : run.preparation.targets.singular)
    poses.near_singular.push_back(data.poses[singular.pose].pose_id);
  return poses;
}

/// With what is known of poses by name.
std::vector<PoseErrorEntry> flagged_errors(const Conclusions& run, const Report::Poses& named) {
  std::vector<PoseErrorEntry> poses = pose_errors(run.data, run.model, run.model.robot, &run.before);
  for (std::size_t i = 0; i < poses.size(); ++i) {
    PoseErrorEntry& pose = poses[i];
    pose.place = pose_place(run.data, run.data.poses[i], run.before, run.model.robot);
    if (std::ranges::find(named.outliers, pose.id) != named.outliers.end()) pose.flags.emplace_back("outlier");
    if (std::ranges::find(named.near_singular, pose.id) != named.near_singular.end())
      pose.flags.emplace_back("near_singular");
  }
  return poses;
}

JointEntry joint_entry(const JointSummary& summary, const CalibratedModel& model) {
  const JointCorrection& correction = model.robot.corrections[static_cast<std::size_t>(summary.joint)];
  const Interval range = correction.range_rad();
  JointEntry entry{.joint = static_cast<std::uint64_t>(summary.joint) + 1,
                   .kept = summary.kept,
                   .expression = to_string(correction.formula()),
                   .mean_abs_error_rad = {if_finite(summary.before_rad), if_finite(summary.after_rad)},
                   .range_rad = {},
                   .bound_rad = if_finite(summary.bound_rad),
                   .limit_rad = {},
                   .discontinuities_rad = summary.discontinuities_rad,
                   .with_functions = {},
                   .note = summary.note,
                   .origin = {},
                   .short_form = {},
                   .as_evolved = {},
                   .as_evolved_error_rad = {}};
  if (std::isfinite(range.lower) && std::isfinite(range.upper)) entry.range_rad = range;
  const FoldedFormula calling = folded_correction(correction, model.functions);
  if (!calling.calls.empty()) entry.with_functions = to_string(calling);
  return entry;
}

/// `joints`: as they were calibrated, for a model file says neither where its formulas are from nor what held them.
void add_origins_and_limits(const std::vector<JointSummary>& joints, std::vector<JointEntry>& entries) {
  for (std::size_t joint = 0; joint < std::min(joints.size(), entries.size()); ++joint) {
    if (!entries[joint].kept) continue;
    entries[joint].origin = to_string(joints[joint].origin);
    entries[joint].limit_rad = joints[joint].limit_rad;
  }
}

/// What joints evolved beside what they kept, where each learnt from its own targets: the corrections of distal
/// learning stand in its steps.
void add_as_evolved(const Conclusions& run, Report& report) {
  if (run.model.method != Method::direct) return;
  CorrectedRobot robot = run.preparation.declared.robot;
  const std::vector<EvolvedCorrection> fittest = as_evolved(run.candidates);
  for (const EvolvedCorrection& one : fittest) {
    const auto joint = static_cast<std::size_t>(one.joint);
    robot.corrections[joint] = one.correction;
    if (joint >= report.joints.size()) continue;
    report.joints[joint].as_evolved = to_string(one.correction.formula());
    report.joints[joint].as_evolved_error_rad = if_finite(one.mean_abs_error_rad);
  }
  if (!fittest.empty()) report.as_evolved = errors_by_set(robot, run.data);
}

void add_short_forms(const Conclusions& run, std::vector<JointEntry>& joints) {
  if (joints.empty()) return;
  const std::vector<std::optional<ShortForm>> forms = short_forms(run.data, run.model.robot);
  for (std::size_t joint = 0; joint < joints.size(); ++joint)
    if (forms[joint]) joints[joint].short_form = forms[joint]->text;
}

std::optional<std::vector<SharedFunctionEntry>> function_entries(const CalibratedModel& model) {
  if (!model.functions) return std::nullopt;
  std::vector<SharedFunctionEntry> entries;
  for (std::size_t i = 0; i < model.functions->size(); ++i) {
    SharedFunctionEntry& entry = entries.emplace_back();
    entry.definition = definition_text((*model.functions)[i], i);
    for (const int joint : joints_calling(model.robot, *model.functions, i))
      entry.joints.push_back(static_cast<std::uint64_t>(joint) + 1);
  }
  return entries;
}

/// Of base, tools and links; effects stand with the rounds that added them.
std::vector<ParameterEntry> parameter_entries(const Conclusions& run) {
  std::vector<ParameterEntry> entries;
  for (const ParameterEstimate& estimate : run.model.estimates) {
    if (estimate.id.kind == ParameterId::Kind::effect) continue;
    entries.push_back(parameter_entry(estimate));
  }
  for (const FoundTransform& transform : run.structure) {  // nominally there is nothing between the links
    entries.push_back({transform.name(), 0.0, if_finite(transform.at_border(transform.value)),
                       if_finite(transform.at_border(transform.standard_error))});
  }
  return entries;
}

std::vector<DistalEntry> distal_entries(const std::vector<DistalStep>& steps) {
  std::vector<DistalEntry> entries;
  for (const DistalStep& step : steps) {
    entries.push_back({static_cast<std::uint64_t>(step.joint) + 1, step.generation,
                       to_string(step.correction.formula()), if_finite(step.index_mm2)});
  }
  return entries;
}

RuntimeEntry runtime_entry(const RunFacts& facts) {
  RuntimeEntry entry{.wall_s = if_finite(facts.wall_s),
                     .workers = facts.workers,
                     .islands = facts.islands,
                     .generations = facts.generations,
                     .evaluations = facts.evaluations,
                     .migrations = facts.migrations,
                     .evolved_sets = facts.evolved_sets,
                     .dropped_samples = facts.dropped_samples,
                     .interrupted = facts.interrupted,
                     .asynchronous = facts.asynchronous,
                     .resumed = facts.resumed,
                     .waited_share = {}};
  for (const auto& [worker, share] : facts.waited_share) entry.waited_share.push_back({worker, if_finite(share)});
  return entry;
}

/// Whether the report says something of joints: where corrections were evolved, or are in the model all the same.
bool has_joints(const CalibratedModel& model) {
  const bool evolves = has_islands(model.method);
  return evolves || has_corrections(model.robot);
}

}  // namespace

std::optional<double> noise_floor_mm(const DataSet& data) {
  std::vector<std::size_t> all(data.poses.size());
  std::iota(all.begin(), all.end(), std::size_t{0});
  const std::optional<PureError> repeats = pure_error(data, all);
  if (!repeats) return std::nullopt;
  return millimetres(repeats->deviation_m);
}

ParameterEntry parameter_entry(const ParameterEstimate& estimate) {
  const double border = estimate.id.is_angle() ? degrees(1.0) : millimetres(1.0);
  return {estimate.id.name(), if_finite(estimate.nominal * border), if_finite(estimate.value * border),
          if_finite(estimate.standard_error * border)};
}

Report make_report(const Conclusions& run) {
  const DataSet& data = run.data;
  const CalibratedModel& model = run.model;
  Report report;
  report.job = model.job;
  report.robot = model.nominal.name;
  report.method = to_string(model.method);
  report.seed = model.seed;
  report.data_sha256 = model.data_sha256;
  report.version = model.version;
  report.data_check = data_check_entry(run.check);
  report.poses = named_poses(run);
  report.nominal = errors_by_set(run.preparation.nominal, data);
  report.registered = errors_by_set(run.preparation.registered.robot, data);
  report.declared = errors_by_set(run.preparation.declared.robot, data);
  report.before = errors_by_set(run.before, data);
  report.after = errors_by_set(model.robot, data);
  report.stations = station_entries(run);
  report.fitted_sets = {"calibration"};
  if (const std::optional<UnseenValidation>& unseen = run.calibration.unseen) {
    report.fitted_sets.emplace_back("validation");
    report.unseen_validation_rms_mm = BeforeAfter{if_finite(unseen->before_mm), if_finite(unseen->after_mm)};
  }
  report.pose_errors = flagged_errors(run, report.poses);
  if (!data.poses.empty()) report.arm = arm_entry(model.robot, data.poses.front().target);
  report.contacts = contact_entries(data, run.preparation.registered.robot, run.before, model.robot);
  report.length_errors = length_error_entries(data, model.robot, &run.before);
  const std::vector<std::size_t> fitted =
      run.calibration.unseen ? poses_of_last_fit(data) : poses_of(data, PoseSet::calibration);
  report.contact_notes = contact_notes(data, model.robot, report.length_errors, report.fitted_sets,
                                       second_place_sentence(data, model, fitted));
  if (model.interval) report.prediction_interval = prediction_entry(*model.interval);
  report.workspace_error = without_figures_of_one_contact(workspace_entry(model, has_instrument(data)), data);
  report.noise_floor_mm = noise_floor_mm(data);
  set_loop(run.loop, model.nominal, report);
  set_causes(run.calibration.budget, model.robot, model.nominal, report);
  report.unexplained = unexplained_error(report);
  report.performance_index_mm2 = {if_finite(run.calibration.index_before_mm2),
                                  if_finite(run.calibration.index_after_mm2)};
  if (has_joints(model))
    for (const JointSummary& summary : model.joints) report.joints.push_back(joint_entry(summary, model));
  add_origins_and_limits(run.calibration.joints, report.joints);
  add_as_evolved(run, report);
  add_short_forms(run, report.joints);
  report.shared_functions = function_entries(model);
  if (model.method == Method::distal) report.distal = distal_entries(run.distal);
  report.parameters = parameter_entries(run);
  if (model.method != Method::structural) {  // its declared fit is only there to compare with
    for (const UnidentifiedDirection& direction : run.preparation.declared.unidentified)
      report.unidentified.push_back(direction.sentence());
  }
  report.runtime = runtime_entry(run.runtime);
  return report;
}

Report refusal_report(const DataSet& data, const std::string& job, const DataCheck& check) {
  Report report;
  report.job = job;
  report.robot = data.robot.name;
  report.method = "none";
  report.seed = 0;
  report.data_sha256 = data.sha256;
  report.version = DEMECAL_VERSION;
  report.data_check = data_check_entry(check);
  report.poses = counts_of(data);
  report.nominal = errors_by_set(nominal_robot(data), data);
  report.fitted_sets = {"calibration"};
  report.runtime = runtime_entry({});
  return report;
}

}  // namespace demecal::inline report
