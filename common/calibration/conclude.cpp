#include <cmath>

#include "calibration/calibration.hpp"
#include "calibration/shortened.hpp"
#include "effects/measurement.hpp"
#include "kinematics/units.hpp"

namespace demecal {
namespace {

std::string why_neutral(const Job& job, const Selection& selection, const DataSet& data, int joint) {
  if (!job.declared.joint_corrections) return "joint corrections are not declared";
  if (!is_revolute(data.robot.chain, joint)) return "a prismatic joint";
  for (const JointChoice& choice : selection.choices) {
    if (choice.joint == joint) return "no evolved correction earned its place on the validation poses";
  }
  return "the joint hardly moves over the calibration poses";
}

/// The declared numbers fitted again with the corrections in place, where the deciding poses agree.
void refit(const DataSet& data, const Job& job, std::span<const std::size_t> deciding, const FitOptions& options,
           Calibration& result) {
  const Fit again = fit_declared(data, poses_of(data, PoseSet::calibration), job.declared, result.robot, options);
  if (again.status != FitStatus::converged) return;
  const double present_mm2 = performance_index_mm2(result.robot, data, deciding);
  if (performance_index_mm2(again.robot, data, deciding) > present_mm2) return;
  result.robot = again.robot;
  result.estimates = again.estimates;
}

}  // namespace

std::vector<std::size_t> deciding_poses(const DataSet& data) {
  std::vector<std::size_t> deciding = poses_of(data, PoseSet::validation);
  return deciding.empty() ? poses_of(data, PoseSet::calibration) : deciding;
}

double performance_index_mm2(const CorrectedRobot& robot, const DataSet& data, std::span<const std::size_t> poses) {
  double sum = 0.0;
  for (const std::size_t pose : poses) {
    const double error_m = tool_error_m(robot, data, data.poses[pose]);
    const MeasurementRows rows = rows_of(data.poses[pose]);
    if (rows.position + rows.distances > 0) sum += std::pow(millimetres(error_m), 2);
  }
  return sum;
}

Calibration conclude(const DataSet& data, const Job& job, const Preparation& preparation,
                     const std::vector<JointCandidates>& evolved, const FitOptions& options) {
  std::vector<JointCandidates> candidates = evolved;
  for (JointCandidates& joint : candidates) write_briefly(joint, job.gp);
  const std::vector<std::size_t> fitted = poses_of(data, PoseSet::calibration);
  const std::vector<std::size_t> deciding = deciding_poses(data);
  const Selection selection = select_corrections(data, fitted, deciding, preparation.declared.robot, candidates);
  Calibration result{.robot = with_shortened_corrections(selection.robot),
                     .estimates = preparation.declared.estimates,
                     .joints = {},
                     .unseen = {}};
  bool any = false;
  for (const JointChoice& choice : selection.choices) any = any || choice.kept;
  if (any) refit(data, job, deciding, options, result);
  const bool exact = preparation.target_options.kind == TargetKind::exact || !any;
  result.joints = joint_summaries(
      preparation.targets, exact ? preparation.targets : targets_about(data, preparation, result.robot), result.robot);
  for (JointSummary& summary : result.joints) {
    if (!summary.kept) summary.note = why_neutral(job, selection, data, summary.joint);
  }
  result.index_before_mm2 = performance_index_mm2(preparation.declared.robot, data, fitted);
  result.index_after_mm2 = performance_index_mm2(result.robot, data, fitted);
  return result;
}

}  // namespace demecal
