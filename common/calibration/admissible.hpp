// Which of a joint's candidates may become its correction at all, and which corrections are none.
#pragma once

#include <vector>

#include "calibration/selection.hpp"
#include "data/data_set.hpp"
#include "prediction/corrected_robot.hpp"

namespace demecal::inline calibration {

/// A joint's candidates that may be considered, those evolved first, then their short forms, then those from elsewhere:
/// bounded within the joint's limit (see is_bounded), and with at most four jumps over its range.
std::vector<JointCorrection> admissible_corrections(const JointCandidates& candidates);

/// What evolution ended with: of the bounded members of the front the fittest; neutral where there is none.
JointCorrection fittest_correction(const JointCandidates& candidates);

/// The robot without corrections that do nothing: that stay below a microradian (micrometre) over their range, or move
/// the tool of no pose by a micrometre nor, where any orientation was measured, turn it by a microradian.
CorrectedRobot without_negligible_corrections(const DataSet& data, CorrectedRobot robot);

}  // namespace demecal::inline calibration
