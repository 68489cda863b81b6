#include <cmath>

#include "calibration/calibration.hpp"
#include "effects/measurement.hpp"

namespace demecal {
namespace {

/// A jump smaller than this moves a tool a metre away by less than a hundredth of a millimetre.
constexpr double kSmallestJumpRad = 1e-5;

double index_mm2(const CorrectedRobot& robot, const DataSet& data, std::span<const std::size_t> poses) {
  double sum = 0.0;
  for (const std::size_t pose : poses) sum += std::pow(1e3 * tool_error_m(robot, data, data.poses[pose]), 2);
  return sum;
}

/// Mean absolute of the joint's target error less `correction`, over poses that have one.
double mean_abs_rad(const JointTargets& targets, int joint, const JointCorrection& correction) {
  double sum = 0.0;
  std::size_t counted = 0;
  for (std::size_t row = 0; row < targets.poses.size(); ++row) {
    if (targets.weight[row] <= 0.0) continue;
    sum += std::abs(targets.error[row][joint] - correction(targets.commanded[row][joint]));
    ++counted;
  }
  return counted > 0 ? sum / static_cast<double>(counted) : 0.0;
}

JointSummary summarise(const JointTargets& targets, int joint, const JointCorrection& correction) {
  JointSummary summary;
  summary.joint = joint;
  summary.kept = !correction.is_neutral();
  summary.before_rad = mean_abs_rad(targets, joint, JointCorrection{});
  summary.after_rad = mean_abs_rad(targets, joint, correction);
  if (summary.kept) {
    summary.bound_rad = magnitude_bound(correction.formula(), correction.range_rad());
    summary.discontinuities_rad = discontinuities(correction.formula(), correction.range_rad(), kSmallestJumpRad);
  }
  return summary;
}

std::string why_neutral(const Job& job, const Selection& selection, const DataSet& data, int joint) {
  if (!job.declared.joint_corrections) return "joint corrections are not declared";
  if (data.robot.chain.joints[static_cast<std::size_t>(joint)].type != JointType::revolute) return "a prismatic joint";
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
  if (index_mm2(again.robot, data, deciding) > index_mm2(result.robot, data, deciding)) return;
  result.robot = again.robot;
  result.estimates = again.estimates;
}

}  // namespace

Calibration conclude(const DataSet& data, const Job& job, const Preparation& preparation,
                     const std::vector<JointCandidates>& candidates, const FitOptions& options) {
  const std::vector<std::size_t> fitted = poses_of(data, PoseSet::calibration);
  std::vector<std::size_t> deciding = poses_of(data, PoseSet::validation);
  if (deciding.empty()) deciding = fitted;
  const Selection selection = select_corrections(data, fitted, deciding, preparation.declared.robot, candidates);
  Calibration result{.robot = selection.robot, .estimates = preparation.declared.estimates, .joints = {}};
  bool any = false;
  for (const JointChoice& choice : selection.choices) any = any || choice.kept;
  if (any) refit(data, job, deciding, options, result);
  for (int joint = 0; joint < result.robot.chain.size(); ++joint) {
    JointSummary summary =
        summarise(preparation.targets, joint, result.robot.corrections[static_cast<std::size_t>(joint)]);
    if (!summary.kept) summary.note = why_neutral(job, selection, data, joint);
    result.joints.push_back(std::move(summary));
  }
  result.index_before_mm2 = index_mm2(preparation.declared.robot, data, fitted);
  result.index_after_mm2 = index_mm2(result.robot, data, fitted);
  return result;
}

}  // namespace demecal
