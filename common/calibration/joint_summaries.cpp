#include "calibration/joint_summaries.hpp"

#include <algorithm>
#include <cmath>

namespace demecal {
namespace {

/// A jump smaller than this moves a tool a metre away by less than a hundredth of a millimetre.
constexpr double kSmallestJumpRad = 1e-5;

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

}  // namespace

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

bool has_corrections(const CorrectedRobot& robot) {
  return !std::ranges::all_of(robot.corrections, &JointCorrection::is_neutral);
}

CorrectedRobot without_corrections(CorrectedRobot robot) {
  std::ranges::fill(robot.corrections, JointCorrection{});
  return robot;
}

}  // namespace demecal
