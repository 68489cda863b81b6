// Zeros of joints in the check for a change: those that the poses do not see, and what of those found may be heat.
#pragma once

#include <vector>

#include "effects/effect.hpp"
#include "prediction/corrected_robot.hpp"
#include "updating/change.hpp"
#include "updating/change_rows.hpp"

namespace demecal::inline updating {

/// Of every joint whose zero the poses find nine times in ten only where it is off by more than 10 mrad or 10 mm.
std::vector<UnseenZero> unseen_zeros(const ScaledChangeRows& scaled, const ChangeRows& rows,
                                     const std::vector<Effect>& effects, bool set_up_anew);

/// Of the zeros among `found` with which something of the temperature was found as well, or may have been in their
/// place: those are among `tried`. `robot`: the model's.
std::vector<WarmedZero> warmed_zeros(const std::vector<ChangeCause>& found, const std::vector<ChangeCause>& tried,
                                     const CorrectedRobot& robot);

}  // namespace demecal::inline updating
