// The charts of a joint: its correction over the calibrated range, and how its formulas evolved.
#pragma once

#include <string>
#include <vector>

#include "expression/bound.hpp"
#include "expression/tree.hpp"
#include "report/history.hpp"

namespace demecal {

/// The correction in mrad over the joint angle in degrees, as inline SVG, with a line at zero and marks at its jumps,
/// where the curve is broken. Where single peaks dwarf the rest (poles), they leave the picture at its edge. `formula`
/// has the one variable theta and gives rad; `range_rad` is finite and not empty; `jumps_rad` ascend.
std::string correction_chart(const Tree& formula, const Interval& range_rad, const std::vector<double>& jumps_rad,
                             const std::string& label);

/// One line per island with one point per row of the history, fitness on a logarithmic scale that all joints of
/// `history` share, as inline SVG. Empty where the joint has no points.
std::string fitness_chart(const FitnessHistory& history, std::uint64_t joint);

/// The best of all: "best 1.23 in generation 200, island 2"; empty where the joint has no points.
std::string fitness_caption(const FitnessHistory& history, std::uint64_t joint);

}  // namespace demecal
