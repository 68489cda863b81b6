#include "diagnosis/final_fit.hpp"

#include <algorithm>

#include "diagnosis/candidates.hpp"
#include "diagnosis/evidence.hpp"

namespace demecal {

std::vector<std::size_t> poses_of_last_fit(const DataSet& data) {
  std::vector<std::size_t> poses = poses_of(data, PoseSet::calibration);
  if (poses_of(data, PoseSet::accept).empty()) return poses;
  std::ranges::copy(poses_of(data, PoseSet::validation), std::back_inserter(poses));
  std::ranges::sort(poses);
  return poses;
}

DiagnosedModel final_fit(const DataSet& data, const DeclaredModel& declared, DiagnosedModel model) {
  constexpr int kSteps = 12;
  const std::vector<std::size_t> poses = poses_of_last_fit(data);
  if (poses == poses_of(data, PoseSet::calibration)) return model;
  const Evidence evidence = evidence_of(data, poses);
  for (Effect& effect : model.robot.effects) set_measured_ranges(effect, data.robot, evidence);
  if (!model.smooth.terms.empty()) {
    CorrectedRobot base = model.robot;
    base.corrections = model.smooth.base;
    model.smooth = smooth_corrections(data, poses, base, declared.joint_corrections, declared.joint_offset);
    model.robot.corrections = model.smooth.corrections();
  }
  return refined({data, declared, poses, {}}, std::move(model), kSteps);
}

}  // namespace demecal
