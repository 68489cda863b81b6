// Changes so large that the check of the data takes the poses for those of another robot.
#pragma once

#include "updating/change.hpp"

namespace demecal::inline updating {

/// Whether zeros, tool and base that were found leave no more than an unchanged robot would, of poses that are still
/// `implausible_m` off at the median where base, tool and links are fitted to them: more than any robot of their
/// description.
bool explains_implausible(const ChangeReport& change, double implausible_m);

/// Whether it is such a change, or a zero is off by 3 degrees or 15 mm and more: by no wear.
bool is_far_beyond_usual(const ChangeReport& change);

}  // namespace demecal::inline updating
