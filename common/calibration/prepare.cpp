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

}  // namespace

Preparation prepare(const DataSet& data, const Job& job, const FitOptions& options) {
  Preparation preparation;
  preparation.nominal = nominal_robot(data);
  const std::vector<std::size_t> poses = poses_of(data, PoseSet::calibration);
  require_poses(poses.size(), data, job);
  preparation.registered = fit_registration(data, poses, job.declared, preparation.nominal, options);
  require(preparation.registered, data);
  preparation.declared = fit_declared(data, poses, job.declared, preparation.registered.robot, options);
  require(preparation.declared, data);
  if (job.declared.joint_corrections) {
    preparation.targets = joint_targets(data, poses, preparation.declared.robot);
    preparation.training = training_tables(preparation.declared.robot.chain, preparation.targets);
  }
  return preparation;
}

}  // namespace demecal
