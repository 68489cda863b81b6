#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <functional>
#include <iterator>
#include <limits>
#include <memory>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "calibration/admissible.hpp"
#include "calibration/calibration.hpp"
#include "calibration/job.hpp"
#include "calibration/joint_targets.hpp"
#include "calibration/selection.hpp"
#include "calibration/training.hpp"
#include "data/data_set.hpp"
#include "expression/bound.hpp"
#include "fitting/fit.hpp"
#include "kinematics/chain.hpp"
#include "kinematics/units.hpp"
#include "parameters/declared_model.hpp"
#include "pieces/pieces.hpp"
#include "prediction/corrected_robot.hpp"
#include "prediction/measurement.hpp"

namespace demecal::inline calibration {
namespace {

/// A jump smaller than this moves a tool a metre away by less than a hundredth of a millimetre.
constexpr double kSmallestJumpRad = 1e-5;

/// Mean absolute of the joint's target error less `correction`, over poses that have one; NaN: none has.
double mean_abs_rad(const JointTargets& targets, int joint, const JointCorrection& correction) {
  double sum = 0.0;
  std::size_t counted = 0;
  for (std::size_t row = 0; row < targets.poses.size(); ++row) {
    if (targets.weight[row] <= 0.0) continue;
    sum += std::abs(targets.error[row][joint] - correction(targets.commanded[row][joint]));
    ++counted;
  }
  return counted > 0 ? sum / static_cast<double>(counted) : std::numeric_limits<double>::quiet_NaN();
}

std::string why_neutral(const Job& job, std::span<const JointCandidates> candidates, const DataSet& data, int joint) {
  if (!job.declared.joint_corrections) return "joint corrections are not declared";
  if (!is_revolute(data.robot.chain, joint)) return "a prismatic joint";
  for (const JointCandidates& candidate : candidates) {
    if (static_cast<int>(candidate.training.joint) == joint)
      return "no evolved correction earned its place on the validation poses";
  }
  return "the joint hardly moves over the calibration poses";
}

/// The declared numbers fitted again with the corrections in place, where the selection poses agree.
void refit(const DataSet& data, const Job& job, std::span<const std::size_t> selecting, const FitOptions& options,
           Calibration& result) {
  if (!has_corrections(result.robot)) return;
  const Fit again = fit_declared(data, poses_of(data, PoseSet::calibration), job.declared, result.robot, options);
  if (again.status != FitStatus::converged) return;
  const double present_mm2 = performance_index_mm2(result.robot, data, selecting);
  if (performance_index_mm2(again.robot, data, selecting) > present_mm2) return;
  result.robot = again.robot;
  result.estimates = again.estimates;
}

/// What the selection poses choose among what evolved, with the declared numbers fitted again.
Calibration with_best_corrections(const DataSet& data, const Job& job, const Preparation& preparation,
                                  std::span<const JointCandidates> candidates, const FitOptions& options) {
  const CorrectedRobot& declared = preparation.declared.robot;
  const std::vector<std::size_t> selecting = selection_poses(data, declared);
  const Selection selection = select_corrections(data, without_gross_errors(data, PoseSet::calibration, declared),
                                                 selecting, declared, candidates);
  Calibration calibration{.robot = with_shortened_corrections(selection.robot),
                          .estimates = preparation.declared.estimates,
                          .joints = {},
                          .unseen = {}};
  refit(data, job, selecting, options, calibration);
  calibration.robot = without_negligible_corrections(data, std::move(calibration.robot));
  return calibration;
}

}  // namespace

std::string to_string(FormulaOrigin origin) {
  switch (origin) {
    case FormulaOrigin::evolved:
      return "evolved";
    case FormulaOrigin::smooth_terms:
      return "smooth_terms";
    case FormulaOrigin::evolved_and_smooth_terms:
      return "evolved_and_smooth_terms";
    case FormulaOrigin::unstated:
      break;
  }
  return {};
}

std::vector<JointSummary> joint_summaries(const JointTargets& declared, const JointTargets& now,
                                          const CorrectedRobot& robot) {
  std::vector<JointSummary> summaries;
  for (int joint = 0; joint < robot.chain.size(); ++joint) {
    const JointCorrection& correction = robot.corrections[static_cast<std::size_t>(joint)];
    JointSummary summary{.joint = joint, .kept = !correction.is_neutral(), .note = {}};
    summary.before_rad = mean_abs_rad(declared, joint, JointCorrection{});
    summary.after_rad = mean_abs_rad(now, joint, correction);
    if (summary.kept) {
      summary.bound_rad = magnitude_bound(correction.formula(), correction.range_rad());
      summary.discontinuities_rad = discontinuities(correction.formula(), correction.range_rad(), kSmallestJumpRad);
    }
    summaries.push_back(std::move(summary));
  }
  return summaries;
}

std::vector<std::size_t> without_gross_errors(const DataSet& data, PoseSet set, const CorrectedRobot& declared) {
  std::vector<double> errors_m;
  for (const PoseSet some : {PoseSet::calibration, PoseSet::validation})
    std::ranges::copy(tool_errors_m(declared, data, poses_of(data, some)), std::back_inserter(errors_m));
  const double limit_m = gross_error_limit(std::move(errors_m));
  const std::vector<std::size_t> poses = poses_of(data, set);
  const std::vector<double> own_m = tool_errors_m(declared, data, poses);
  std::vector<std::size_t> kept;
  for (std::size_t i = 0; i < poses.size(); ++i)
    if (!(own_m[i] > limit_m)) kept.push_back(poses[i]);
  return kept;
}

std::vector<std::size_t> selection_poses(const DataSet& data, const CorrectedRobot& declared) {
  const bool validated = !poses_of(data, PoseSet::validation).empty();
  return without_gross_errors(data, validated ? PoseSet::validation : PoseSet::calibration, declared);
}

double performance_index_mm2(const CorrectedRobot& robot, const DataSet& data, std::span<const std::size_t> poses) {
  double sum = 0.0;
  const std::vector<double> errors_m = tool_errors_m(robot, data, poses);
  for (std::size_t i = 0; i < poses.size(); ++i) {
    const MeasurementRows rows = rows_of(data.poses[poses[i]]);
    if (rows.points() + rows.distances > 0) sum += std::pow(millimetres(errors_m[i]), 2);
  }
  return sum;
}

Calibration conclude(const DataSet& data, const Job& job, const Preparation& preparation,
                     const std::vector<JointCandidates>& evolved, const FitOptions& options) {
  std::vector<JointCandidates> candidates = evolved;
  in_pieces(candidates.size(), [&](std::size_t i) { add_short_forms(candidates[i], job.gp); });
  const CorrectedRobot& declared = preparation.declared.robot;
  Calibration result = with_best_corrections(data, job, preparation, candidates, options);
  const bool any = has_corrections(result.robot);
  const bool exact = preparation.target_options.kind == TargetKind::exact || !any;
  result.joints = joint_summaries(
      preparation.targets, exact ? preparation.targets : targets_about(data, preparation, result.robot), result.robot);
  for (JointSummary& summary : result.joints) {
    if (summary.kept) summary.origin = FormulaOrigin::evolved;
    if (!summary.kept) summary.note = why_neutral(job, candidates, data, summary.joint);
  }
  const std::vector<std::size_t> fitted = poses_of(data, PoseSet::calibration);
  result.index_before_mm2 = performance_index_mm2(declared, data, fitted);
  result.index_after_mm2 = performance_index_mm2(result.robot, data, fitted);
  return result;
}

}  // namespace demecal::inline calibration
