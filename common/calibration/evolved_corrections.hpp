// What evolution gave every joint, before anything was chosen: for people who choose themselves.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "calibration/selection.hpp"
#include "prediction/corrected_robot.hpp"

namespace demecal::inline calibration {

/// A correction as it evolved.
struct EvolvedCorrection {
  int joint = 0;  ///< from 0
  JointCorrection correction;
  double mean_abs_error_rad = 0.0;  ///< that it leaves of the joint's targets
  double bound_rad = 0.0;           ///< over its range; infinite where a pole cannot be excluded
  std::size_t jumps = 0;
};

/// Every member of the fronts of all joints: the best of each length.
std::vector<EvolvedCorrection> evolved_fronts(std::span<const JointCandidates> candidates);

/// The fittest bounded one of every joint that has any.
std::vector<EvolvedCorrection> as_evolved(std::span<const JointCandidates> candidates);

}  // namespace demecal::inline calibration
