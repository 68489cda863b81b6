// The plot of a joint's correction over the range it was calibrated on.
#pragma once

#include <string>
#include <vector>

#include "expression/interval.hpp"
#include "expression/tree.hpp"

namespace demecal {

/// The correction in mrad over the joint angle in degrees, as inline SVG, with a line at zero and marks at its jumps,
/// where the curve is broken. Where single peaks dwarf the rest (poles), they leave the picture at its edge. `formula`
/// has the one variable theta and gives rad; `range_rad` is finite and not empty; `jumps_rad` ascend.
std::string correction_chart(const Tree& formula, const Interval& range_rad, const std::vector<double>& jumps_rad,
                             const std::string& label);

}  // namespace demecal
