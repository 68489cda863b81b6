// Zeros of joints in the check for a change: those that the poses do not see, and what of those found may be heat.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "data/data_set.hpp"
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

/// Said where zeros were found, the model has effects of the temperature, and these poses do not show what it does:
/// they do not state it, or it is the same at all of them. Empty otherwise.
std::string unseen_heat_sentence(const std::vector<ChangeCause>& found, const CorrectedRobot& robot,
                                 const DataSet& data, const std::vector<std::size_t>& poses);

}  // namespace demecal::inline updating
