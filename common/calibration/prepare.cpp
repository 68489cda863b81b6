#include <Eigen/Core>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "calibration/calibration.hpp"
#include "calibration/job.hpp"
#include "calibration/joint_targets.hpp"
#include "calibration/training.hpp"
#include "data/data_set.hpp"
#include "errors/input_error.hpp"
#include "fitting/fit.hpp"
#include "fitting/least_squares.hpp"
#include "kinematics/chain.hpp"
#include "parameters/declared_model.hpp"
#include "parameters/observation.hpp"
#include "prediction/corrected_robot.hpp"
#include "prediction/measurement.hpp"
#include "residuals/diagnosed_model.hpp"

namespace demecal::inline calibration {
namespace {

/// Below it a formula per joint fits anything.
constexpr std::size_t kLeastPoses = 6;
constexpr int kSmoothSteps = 12;  ///< of Gauss and Newton

void require_poses(std::size_t poses, const DataSet& data, const Job& job) {
  if (!job.declared.joint_corrections || poses >= kLeastPoses) return;
  throw InputError({data.file, 0}, std::to_string(poses),
                   "calibration poses are too few: joint corrections need at least " + std::to_string(kLeastPoses));
}

void require_fit(const Fit& fit, const DataSet& data) {
  if (fit.status == FitStatus::too_few_poses) throw InputError({data.file, 0}, "", fit.sentence);
  if (fit.status == FitStatus::not_converged)
    throw InputError({data.file, 0}, "",
                     "no model fits these poses: " + fit.sentence +
                         ". Correct what was found in the data, if anything was; otherwise declare less, or measure "
                         "more poses that differ more");
}

/// Where links are fitted beside base and tool, those alone are a start, which need not have come to rest: precise
/// lengths between contacts can contradict the described links.
void require_start(const Fit& fit, const DataSet& data, const DeclaredModel& declared) {
  const bool only_start = declared.geometry || declared.joint_offset;
  if (!only_start || fit.status != FitStatus::not_converged) require_fit(fit, data);
}

/// Poses in the base's frame need no base, whatever the frame the model was found in.
CorrectedRobot placed_in_frame(const DataSet& data, std::span<const std::size_t> poses, const CorrectedRobot& model) {
  CorrectedRobot in_base = model;
  in_base.sensor_from_base = Eigen::Isometry3d::Identity();
  const bool nearer = performance_index_mm2(in_base, data, poses) < performance_index_mm2(model, data, poses);
  return data.frame == Frame::base && nearer ? in_base : model;
}

/// Scales of what the model leaves over these poses, of the kinds of rows that the fit used.
RowScales residual_scales(const DataSet& data, std::span<const std::size_t> poses, const Fit& fit,
                          const CorrectedRobot& model) {
  const RowScales used{fit.sigma_position_m, fit.sigma_orientation_rad, fit.sigma_distance_m};
  RowScales scales = median_deviations(data, model, observe(data, poses, model));
  for (std::size_t kind = 0; kind < kRowKinds; ++kind) {
    if (used[kind] <= 0.0) scales[kind] = 0.0;
  }
  return scales;
}

/// Root mean squares of the correction of one joint, and of what it does to the measured rows.
struct CorrectionSize {
  double joint_rad = 0.0, position_m = 0.0, orientation_rad = 0.0;
};
CorrectionSize correction_size(std::size_t joint, const DataSet& data, std::span<const std::size_t> poses,
                               const CorrectedRobot& corrected) {
  CorrectedRobot without = corrected;
  without.corrections[joint] = JointCorrection{};
  double joint_rad2 = 0.0, position_m2 = 0.0, orientation_rad2 = 0.0;
  for (const std::size_t index : poses) {
    const MeasuredPose& pose = data.poses[index];
    const Eigen::VectorXd moved = residual(corrected, data, pose) - residual(without, data, pose);
    const MeasurementRows rows = rows_of(pose);
    const double angles = moved.segment(rows.points(), rows.orientation).squaredNorm();
    joint_rad2 += std::pow(corrected.corrections[joint](pose.joints[static_cast<Eigen::Index>(joint)]), 2);
    orientation_rad2 += angles;
    position_m2 += moved.squaredNorm() - angles;
  }
  const double count = static_cast<double>(poses.size());
  return {std::sqrt(joint_rad2 / count), std::sqrt(position_m2 / count), std::sqrt(orientation_rad2 / count)};
}

/// A correction that is larger than joints are believed to err, and yet hardly shows beside what scatters about it, is
/// what noise makes of it: an axis through the tool point turns freely.
void drop_unobservable_corrections(const DataSet& data, std::span<const std::size_t> poses, const RowScales& scatter,
                                   double joint_error_rad, CorrectedRobot& robot) {
  constexpr double kUnobservable = 0.3;  ///< of the scatter
  for (std::size_t joint = 0; joint < robot.corrections.size(); ++joint) {
    if (robot.corrections[joint].is_neutral()) continue;
    const CorrectionSize size = correction_size(joint, data, poses, robot);
    if (size.joint_rad < joint_error_rad) continue;
    const double scatter_m = std::max(scatter[kPosition], scatter[kDistance]);
    const bool turns = scatter[kOrientation] > 0.0 && size.orientation_rad > kUnobservable * scatter[kOrientation];
    if (!turns && size.position_m < kUnobservable * scatter_m) robot.corrections[joint] = JointCorrection{};
  }
}

/// Posterior targets about the smooth errors that explain all poses together: one pose alone leaves half of them open.
JointTargets first_targets(const DataSet& data, const Job& job, const Preparation& preparation) {
  const CorrectedRobot& declared = preparation.declared.robot;
  if (job.targets.kind == TargetKind::exact) return targets_about(data, preparation, declared);
  const DiagnosisProblem problem{data, job.declared, poses_of(data, PoseSet::calibration),
                                 poses_of(data, PoseSet::validation)};
  const DiagnosedModel smooth =
      refined(problem, diagnosed_model(problem, loop_start(data, preparation.declared, declared)), kSmoothSteps);
  CorrectedRobot about = declared;
  about.corrections = smooth.robot.corrections;
  drop_unobservable_corrections(data, problem.fitted, smooth.scales, job.targets.joint_error_rad, about);
  return targets_about(data, preparation, about);
}

}  // namespace

Fit loop_start(const DataSet& data, const Fit& declared, const CorrectedRobot& robot) {
  const std::vector<std::size_t> poses = poses_of(data, PoseSet::calibration);
  const CorrectedRobot placed = with_own_contacts(robot, data, poses);
  const RowScales scatter = median_deviations(data, placed, observe(data, poses, placed));
  const auto scale = [&](std::size_t kind, double used) {
    return used > 0.0 ? std::max(scatter[kind], kSmallestScale) : 0.0;
  };
  Fit start = declared;
  start.robot = placed;
  start.sigma_position_m = scale(kPosition, declared.sigma_position_m);
  start.sigma_orientation_rad = scale(kOrientation, declared.sigma_orientation_rad);
  start.sigma_distance_m = scale(kDistance, declared.sigma_distance_m);
  return start;
}

JointTargets targets_about(const DataSet& data, const Preparation& preparation, const CorrectedRobot& model) {
  const std::vector<std::size_t> poses = without_gross_errors(data, PoseSet::calibration, preparation.declared.robot);
  const CorrectedRobot placed = with_own_contacts(model, data, poses);
  return joint_targets(
      data, poses, without_corrections(placed),
      {preparation.target_options, residual_scales(data, poses, preparation.declared, placed), model.corrections});
}

Preparation prepare(const DataSet& data, const Job& job, const FitOptions& options) {
  Preparation preparation;
  preparation.nominal = nominal_robot(data);
  preparation.corrections = job.corrections;
  preparation.target_options = job.targets;
  const std::vector<std::size_t> poses = poses_of(data, PoseSet::calibration);
  require_poses(poses.size(), data, job);
  preparation.registered = fit_registration(data, poses, job.declared, preparation.nominal, options);
  require_start(preparation.registered, data, job.declared);
  preparation.declared = fit_declared(data, poses, job.declared, preparation.registered.robot, options);
  require_fit(preparation.declared, data);
  if (job.declared.joint_corrections) {
    preparation.targets = first_targets(data, job, preparation);
    preparation.training = training_tables(preparation.declared.robot.chain, preparation.targets, job.corrections);
  }
  return preparation;
}

Preparation prepare_from(const DataSet& data, const DeclaredModel& declared, const CorrectedRobot& model,
                         const TargetOptions& target_options) {
  const std::vector<std::size_t> poses = poses_of(data, PoseSet::calibration);
  Preparation preparation;
  preparation.target_options = target_options;
  preparation.nominal = nominal_robot(data);
  preparation.registered = fit_registration(data, poses, declared, preparation.nominal);
  require_fit(preparation.registered, data);
  const Fit placed = fit_registration(data, poses, declared, placed_in_frame(data, poses, model));
  require_fit(placed, data);
  preparation.declared = fit_declared(data, poses, declared, placed.robot, {.starts = 0});
  require_fit(preparation.declared, data);
  if (declared.joint_corrections || has_corrections(model)) {
    preparation.targets = targets_about(data, preparation, preparation.declared.robot);
  }
  return preparation;
}

}  // namespace demecal::inline calibration
