#include "calibration/distal_steps.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "calibration/correction_limit.hpp"
#include "evolution/fitness.hpp"

namespace demecal {

JointTraining distal_training(const JointTraining& like, std::span<const LinearisedPose> poses,
                              std::optional<double> scale_rad) {
  const auto joint = static_cast<Eigen::Index>(like.joint);
  JointTraining training = like;
  training.table.loss = Loss::squared;
  training.table.seeds.clear();
  double most = 0.0;
  for (const LinearisedPose& pose : poses) most = std::max(most, pose.slope_mm.col(joint).squaredNorm());
  double sum = 0.0, weights = 0.0;
  for (std::size_t i = 0; i < poses.size(); ++i) {
    const auto slope = poses[i].slope_mm.col(joint);
    // A joint that moves nothing here learns nothing here.
    const bool moves = slope.squaredNorm() > 1e-12 * most;
    const double weight = moves ? std::min(1.0, slope.squaredNorm() / most) : 0.0;
    const double more = moves ? slope.dot(poses[i].left_mm) / slope.squaredNorm() : 0.0;
    training.table.target[i] = poses[i].correction[joint] + more;
    training.table.weight[i] = weight;
    sum += weight * std::abs(training.table.target[i]);
    weights += weight;
  }
  training.scale_rad = scale_rad ? *scale_rad : round_scale(weights > 0.0 ? sum / weights : 0.0);
  for (double& target : training.table.target) target /= training.scale_rad;
  limit_formulas(training);
  return training;
}

void follow_amplitudes(const CorrectedRobot& robot, std::span<JointTraining> trainings) {
  for (JointTraining& training : trainings) {
    const JointCorrection& correction = robot.corrections[training.joint];
    if (correction.is_neutral()) continue;
    const double factor = evolved_scale_rad(correction) / training.scale_rad;
    training.scale_rad = evolved_scale_rad(correction);
    for (double& target : training.table.target) target /= factor;
    limit_formulas(training);
  }
}

bool take_correction(const DistalIndex& index, const JointTraining& training, const JointCorrection& correction,
                     std::uint32_t generation, DistalOutcome& outcome) {
  JointCorrection& present = outcome.robot.corrections[training.joint];
  JointCorrection before = std::exchange(present, correction);
  const double index_mm2 = index(outcome.robot);
  if (!(index_mm2 < (1.0 - kLeastFall) * outcome.index_mm2)) {
    present = std::move(before);
    return false;
  }
  outcome.index_mm2 = index_mm2;
  outcome.steps.push_back({static_cast<int>(training.joint), generation, correction, index_mm2});
  return true;
}

}  // namespace demecal
