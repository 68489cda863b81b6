#include "calibration/calibration.hpp"
#include "errors/input_error.hpp"

namespace demecal {
namespace {

/// Below it a formula per joint fits anything.
constexpr std::size_t kLeastPoses = 6;

void require_poses(std::size_t poses, const DataSet& data, const Job& job) {
  if (!job.declared.joint_corrections || poses >= kLeastPoses) return;
  throw InputError({data.file, 0}, std::to_string(poses),
                   "calibration poses are too few: joint corrections need at least " + std::to_string(kLeastPoses));
}

void require(const Fit& fit, const DataSet& data) {
  if (fit.status == FitStatus::too_few_poses) throw InputError({data.file, 0}, "", fit.sentence);
  if (fit.status == FitStatus::not_converged)
    throw InputError({data.file, 0}, "", "no model fits these poses: " + fit.sentence);
}

/// Poses in the base's frame need no base, whatever the frame the model was found in.
CorrectedRobot placed_in_frame(const DataSet& data, std::span<const std::size_t> poses, const CorrectedRobot& model) {
  CorrectedRobot in_base = model;
  in_base.sensor_from_base = Eigen::Isometry3d::Identity();
  const bool nearer = performance_index_mm2(in_base, data, poses) < performance_index_mm2(model, data, poses);
  return data.frame == Frame::base && nearer ? in_base : model;
}

}  // namespace

Preparation prepare(const DataSet& data, const Job& job, const FitOptions& options) {
  Preparation preparation;
  preparation.nominal = nominal_robot(data);
  preparation.corrections = job.corrections;
  const std::vector<std::size_t> poses = poses_of(data, PoseSet::calibration);
  require_poses(poses.size(), data, job);
  preparation.registered = fit_registration(data, poses, job.declared, preparation.nominal, options);
  require(preparation.registered, data);
  preparation.declared = fit_declared(data, poses, job.declared, preparation.registered.robot, options);
  require(preparation.declared, data);
  if (job.declared.joint_corrections) {
    preparation.targets = joint_targets(data, poses, preparation.declared.robot);
    preparation.training = training_tables(preparation.declared.robot.chain, preparation.targets, job.corrections);
  }
  return preparation;
}

Preparation prepare_from(const DataSet& data, const DeclaredModel& declared, const CorrectedRobot& model) {
  const std::vector<std::size_t> poses = poses_of(data, PoseSet::calibration);
  Preparation preparation;
  preparation.nominal = nominal_robot(data);
  preparation.registered = fit_registration(data, poses, declared, preparation.nominal);
  require(preparation.registered, data);
  const Fit placed = fit_registration(data, poses, declared, placed_in_frame(data, poses, model));
  require(placed, data);
  preparation.declared = fit_declared(data, poses, declared, placed.robot, {.starts = 0});
  require(preparation.declared, data);
  if (declared.joint_corrections || has_corrections(model)) {
    preparation.targets = joint_targets(data, poses, without_corrections(preparation.declared.robot));
  }
  return preparation;
}

}  // namespace demecal
