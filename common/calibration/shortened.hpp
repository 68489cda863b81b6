// Corrections as they are reported: as short as they can be written without another value.
#pragma once

#include "effects/corrected_robot.hpp"

namespace demecal {

/// The correction with its formula simplified and its terms collected, as far as that keeps its values to 1e-9 of the
/// largest over its range (see simplified_over).
JointCorrection shortened(const JointCorrection& correction);

/// The robot with all its corrections shortened.
CorrectedRobot with_shortened_corrections(CorrectedRobot robot);

}  // namespace demecal
