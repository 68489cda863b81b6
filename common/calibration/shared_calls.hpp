// Where a model's corrections call functions that joints share.
#pragma once

#include <cstddef>
#include <vector>

#include "calibration/evolver.hpp"
#include "effects/corrected_robot.hpp"
#include "expression/shared_function.hpp"

namespace demecal {

/// A correction's formula, g(theta) in rad, with calls of the functions where these make it shorter; without any where
/// there are no functions.
FoldedFormula folded_correction(const JointCorrection& correction, const KnownFunctions& functions);

/// The joints, from 0 and ascending, whose corrections call the function at that place.
std::vector<int> joints_calling(const CorrectedRobot& robot, const std::vector<SharedFunction>& functions,
                                std::size_t place);

}  // namespace demecal
