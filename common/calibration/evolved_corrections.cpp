#include "calibration/evolved_corrections.hpp"

#include <cmath>

#include "calibration/admissible.hpp"
#include "calibration/training.hpp"
#include "expression/bound.hpp"

namespace demecal::inline calibration {
namespace {

EvolvedCorrection described(const JointTraining& training, const JointCorrection& correction) {
  constexpr double kSmallestJump = 1e-5;
  EvolvedCorrection evolved{.joint = static_cast<int>(training.joint), .correction = correction};
  double sum = 0.0;
  std::size_t counted = 0;
  for (std::size_t row = 0; row < training.table.target.size(); ++row) {
    if (training.table.weight[row] <= 0.0) continue;
    sum += std::abs(training.scale_rad * training.table.target[row] - correction(training.table.variables[0][row]));
    ++counted;
  }
  if (counted > 0) evolved.mean_abs_error_rad = sum / static_cast<double>(counted);
  evolved.bound_rad = magnitude_bound(correction.formula(), correction.range_rad());
  evolved.jumps = discontinuities(correction.formula(), correction.range_rad(), kSmallestJump).size();
  return evolved;
}

}  // namespace

std::vector<EvolvedCorrection> evolved_fronts(std::span<const JointCandidates> candidates) {
  std::vector<EvolvedCorrection> all;
  for (const JointCandidates& joint : candidates) {
    for (const Individual& individual : joint.front)
      all.push_back(described(joint.training, correction_from(joint.training, individual.tree)));
  }
  return all;
}

std::vector<EvolvedCorrection> as_evolved(std::span<const JointCandidates> candidates) {
  std::vector<EvolvedCorrection> fittest;
  for (const JointCandidates& joint : candidates) {
    const JointCorrection correction = fittest_correction(joint);
    if (!correction.is_neutral()) fittest.push_back(described(joint.training, correction));
  }
  return fittest;
}

}  // namespace demecal::inline calibration
