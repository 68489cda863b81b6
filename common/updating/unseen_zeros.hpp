// Zeros of joints that poses do not see: whatever they are, the rows stay as
// they are.
#pragma once

#include <vector>

#include "effects/effect.hpp"
#include "updating/change.hpp"
#include "updating/change_rows.hpp"

namespace demecal::inline updating {

/// Of every joint whose zero the poses find nine times in ten only where it is off by more than 10 mrad or 10 mm.
std::vector<UnseenZero> unseen_zeros(const ScaledChangeRows& scaled, const ChangeRows& rows,
                                     const std::vector<Effect>& effects, bool set_up_anew);

}  // namespace demecal::inline updating
