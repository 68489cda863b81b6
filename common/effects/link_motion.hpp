// How a wrong link parameter moves the arm, seen from the place of its joint.
#pragma once

#include <vector>

#include "effects/effect.hpp"

namespace demecal {

/// Appends the motions, at place `joint`, that `size` (rad or m) of a link parameter per unit of `coefficient` makes
/// where the joint is commanded to `q`: its elementary transform's screw in that place's frame.
void append_link_motion(const Chain& chain, int joint, double q, LinkParameter parameter, int coefficient, double size,
                        std::vector<UnitMotion>& motions);

/// Whether the link leads between axes that are parallel to within 0.02 rad, so that Hayati's beta stands for its d.
bool leads_between_parallels(const Chain& chain, int joint);

}  // namespace demecal
