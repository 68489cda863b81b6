#include "report/calibration_report.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

#include "calibration/shared_calls.hpp"
#include "diagnosis/structure.hpp"
#include "effects/error_figures.hpp"
#include "expression/text.hpp"
#include "kinematics/units.hpp"

namespace demecal {
namespace {

std::vector<std::string> ids(const DataSet& data, const std::vector<std::size_t>& poses) {
  std::vector<std::string> names;
  for (const std::size_t pose : poses) {
    const std::string& name = data.poses[pose].pose_id;
    if (std::ranges::find(names, name) == names.end()) names.push_back(name);
  }
  return names;
}

std::vector<std::string> singular_ids(const DataSet& data, const JointTargets& targets) {
  std::vector<std::string> names;
  for (const SingularPose& singular : targets.singular) names.push_back(data.poses[singular.pose].pose_id);
  return names;
}

std::vector<JointLine> joint_lines(const CalibratedModel& model) {
  std::vector<JointLine> lines;
  for (const JointSummary& summary : model.joints) {
    const JointCorrection& correction = model.robot.corrections[static_cast<std::size_t>(summary.joint)];
    lines.push_back({summary, to_text(correction.formula()), correction.range_rad()});
    const FoldedFormula calling = folded_correction(correction, model.functions);
    if (!calling.calls.empty()) lines.back().with_functions = to_text(calling);
  }
  return lines;
}

std::vector<ExcludedPose> excluded_poses(const DataSet& data, const CorrectedRobot& robot) {
  constexpr std::array<const char*, 3> kSetNames{"calibration", "validation", "accept"};
  std::vector<ExcludedPose> excluded;
  for (const MeasuredPose& pose : data.excluded)
    excluded.push_back(
        {pose.pose_id, kSetNames.at(static_cast<std::size_t>(pose.set)), millimetres(tool_error_m(robot, data, pose))});
  return excluded;
}

std::optional<std::vector<SharedFunctionLine>> function_lines(const CalibratedModel& model) {
  if (!model.functions) return std::nullopt;
  std::vector<SharedFunctionLine> lines;
  for (std::size_t i = 0; i < model.functions->size(); ++i)
    lines.push_back({definition_text((*model.functions)[i], i), joints_calling(model.robot, *model.functions, i)});
  return lines;
}

/// What is known of poses by name.
void set_flags(CalibrationReport& report) {
  for (PoseErrorLine& line : report.pose_errors) {
    if (std::ranges::find(report.outliers, line.id) != report.outliers.end()) line.flags.emplace_back("outlier");
    if (std::ranges::find(report.near_singular, line.id) != report.near_singular.end())
      line.flags.emplace_back("near_singular");
  }
}

}  // namespace

ErrorBySet errors_by_set(const CorrectedRobot& robot, const DataSet& data) {
  return {error_figures(robot, data, poses_of(data, PoseSet::calibration)),
          error_figures(robot, data, poses_of(data, PoseSet::validation)),
          error_figures(robot, data, poses_of(data, PoseSet::accept))};
}

std::optional<double> noise_floor_mm(const DataSet& data) {
  std::vector<std::size_t> all(data.poses.size());
  std::iota(all.begin(), all.end(), std::size_t{0});
  const std::optional<PureError> repeats = pure_error(data, all);
  if (!repeats) return std::nullopt;
  return millimetres(repeats->deviation_m);
}

CalibrationReport make_report(const DataSet& data, const CalibratedModel& model, const CorrectedRobot& before,
                              const LoopOutcome& loop, const Preparation& preparation, const Calibration& calibration,
                              const RunFacts& runtime) {
  CalibrationReport report;
  report.job = model.job;
  report.robot = model.nominal.name;
  report.method = word_of(model.method);
  report.data_sha256 = model.data_sha256;
  report.version = model.version;
  report.seed = model.seed;
  report.poses = {poses_of(data, PoseSet::calibration).size(), poses_of(data, PoseSet::validation).size(),
                  poses_of(data, PoseSet::accept).size()};
  const bool looped = loop.stopped != StopReason::not_run;
  report.outliers = ids(data, looped ? loop.outliers : preparation.declared.outliers);
  report.near_singular = singular_ids(data, preparation.targets);
  report.nominal = errors_by_set(preparation.nominal, data);
  report.registered = errors_by_set(preparation.registered.robot, data);
  report.declared = errors_by_set(preparation.declared.robot, data);
  report.before = errors_by_set(before, data);
  report.after = errors_by_set(model.robot, data);
  report.noise_floor_mm = noise_floor_mm(data);
  report.unseen = calibration.unseen;
  report.pose_errors = pose_errors(data, model, model.robot, &before);
  report.interval = model.interval;
  set_flags(report);
  report.loop = loop;
  report.described = model.nominal;
  report.excluded = excluded_poses(data, model.robot);
  report.index_before_mm2 = calibration.index_before_mm2;
  report.index_after_mm2 = calibration.index_after_mm2;
  report.joints = joint_lines(model);
  report.functions = function_lines(model);
  report.estimates = model.estimates;
  for (const UnidentifiedDirection& direction : preparation.declared.unidentified) {
    report.unidentified.push_back(direction.sentence());
  }
  report.runtime = runtime;
  return report;
}

CalibrationReport refusal_report(const DataSet& data, const std::string& job, const DataCheck& check) {
  CalibrationReport report;
  report.check = check;
  report.job = job;
  report.robot = data.robot.name;
  report.method = "none";
  report.data_sha256 = data.sha256;
  report.version = DEMECAL_VERSION;
  report.poses = {poses_of(data, PoseSet::calibration).size(), poses_of(data, PoseSet::validation).size(),
                  poses_of(data, PoseSet::accept).size()};
  report.nominal = errors_by_set(nominal_robot(data), data);
  const ErrorFigures none = error_figures(std::vector<double>{});
  report.registered = report.declared = report.before = report.after = {none, none, none};
  report.index_before_mm2 = report.index_after_mm2 = none.mean_mm;
  report.described = data.robot;
  return report;
}

}  // namespace demecal
