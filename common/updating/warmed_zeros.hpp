// Zeros of joints that were found to be off, and what of that may be heat.
#pragma once

#include <vector>

#include "prediction/corrected_robot.hpp"
#include "updating/change.hpp"

namespace demecal::inline updating {

/// Of the zeros among `found` with which something of the temperature was found as well, or may have been in their
/// place: those are among `tried`. `robot`: the model's.
std::vector<WarmedZero> warmed_zeros(const std::vector<ChangeCause>& found, const std::vector<ChangeCause>& tried,
                                     const CorrectedRobot& robot);

}  // namespace demecal::inline updating
