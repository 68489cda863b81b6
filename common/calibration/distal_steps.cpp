#include "calibration/distal_steps.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "calibration/correction_limit.hpp"
#include "evolution/fitness.hpp"

namespace demecal {
namespace {

constexpr double kLeastFall = 1e-6;  ///< of the index, by a step that counts

/// A joint's candidate with its value at every pose.
struct Offer {
  const JointTraining* training;
  const Tree* tree;
  std::vector<double> value_rad;
};

std::vector<Offer> offers_of(std::span<const JointCandidates> candidates) {
  std::vector<Offer> offers;
  for (const JointCandidates& joint : candidates) {
    ColumnEvaluator evaluate(joint.training.table.variables);
    for (const Individual& individual : joint.front) {
      const std::span<const double> values = evaluate(individual.tree);
      Offer offer{&joint.training, &individual.tree, {values.begin(), values.end()}};
      for (double& value : offer.value_rad) value *= joint.training.scale_rad;
      offers.push_back(std::move(offer));
    }
  }
  return offers;
}

/// By how much the linearised index changes.
double linearised_change(const Offer& offer, std::span<const LinearisedPose> poses) {
  const auto joint = static_cast<Eigen::Index>(offer.training->joint);
  double change = 0.0;
  for (std::size_t i = 0; i < poses.size(); ++i) {
    const auto slope = poses[i].slope_mm.col(joint);
    const double more = offer.value_rad[i] - poses[i].correction[joint];
    change += more * (more * slope.squaredNorm() - 2.0 * slope.dot(poses[i].left_mm));
  }
  return std::isfinite(change) ? change : 0.0;
}

}  // namespace

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

void take_candidates(const DistalIndex& index, std::span<const JointCandidates> candidates, std::uint32_t generation,
                     DistalOutcome& outcome) {
  std::vector<Offer> offers = offers_of(candidates);
  while (!offers.empty()) {
    const std::vector<LinearisedPose> poses = index.linearised(outcome.robot);
    std::vector<double> change;
    for (const Offer& offer : offers) change.push_back(linearised_change(offer, poses));
    const auto best = std::min_element(change.begin(), change.end());
    if (!(*best < -kLeastFall * outcome.index_mm2)) return;
    const auto offer = offers.begin() + (best - change.begin());
    const JointCorrection correction = correction_from(*offer->training, *offer->tree);
    if (is_bounded(correction, *offer->training)) {
      take_correction(index, *offer->training, correction, generation, outcome);
    }
    offers.erase(offer);
  }
}

}  // namespace demecal
