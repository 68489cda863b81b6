// Which of a joint's candidates may become its correction at all, and which corrections are none; and what evolution
// gave every joint, before anything was chosen: for people who choose themselves.
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "calibration/selection.hpp"
#include "data/data_set.hpp"
#include "prediction/corrected_robot.hpp"

namespace demecal::inline calibration {

/// A joint's candidates that may be considered, those evolved first, then their short forms, then that of a set of
/// corrections from elsewhere: bounded within the joint's limit (see is_bounded), and with at most four jumps over its
/// range.
std::vector<JointCorrection> admissible_corrections(const JointCandidates& candidates, std::optional<std::size_t> set);

/// What evolution ended with: of the bounded members of the front the fittest; neutral where there is none.
JointCorrection fittest_correction(const JointCandidates& candidates);

/// The robot without the terms of its corrections' sums that stay below a microradian (micrometre) over their range,
/// and without corrections that do nothing: that stay below a microradian (micrometre) over their range, or move the
/// tool of no pose by a micrometre nor, where any orientation was measured, turn it by a microradian.
CorrectedRobot without_negligible_corrections(const DataSet& data, CorrectedRobot robot);

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
