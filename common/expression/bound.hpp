// How large a formula can become over a range, and where it jumps.
#pragma once

#include <span>
#include <vector>

#include "expression/interval.hpp"
#include "expression/tree.hpp"

namespace demecal {

/// An interval that surely holds every finite value of a one-variable formula over `range`: interval arithmetic on
/// `pieces` equal parts, so that it tightens as they grow. Infinite where a divisor may pass through zero, save that
/// equal subtrees divide to 1 and subtract to 0 and that a divisor which is 0 throughout gives 1.
Interval bound(std::span<const Node> tree, Interval range, int pieces = 256);

/// The largest absolute value of bound(); infinite where a pole cannot be excluded.
double magnitude_bound(std::span<const Node> tree, Interval range, int pieces = 256);

/// Where in `range` a one-variable formula jumps: zeros of SIGN's arguments and of divisors at which the value really
/// changes by more than `smallest_jump`, be it at that point alone. Ascending; found on a grid of `grid` points, at
/// least 3, and bisected: of several zeros between two neighbours of the grid, one is found or none. A divisor that
/// touches zero without changing sign is sought where its size is least on the grid.
std::vector<double> discontinuities(const Tree& tree, Interval range, double smallest_jump, int grid = 2048);

}  // namespace demecal
