// How large a formula can become over a range, and where it jumps.
#pragma once

#include <span>
#include <vector>

#include "expression/tree.hpp"

namespace demecal {

struct Interval {
  double lower = 0.0;
  double upper = 0.0;
};

/// An interval that surely holds every value of a one-variable formula over `range`: interval arithmetic on `pieces`
/// equal parts, so that it tightens as they grow. Infinite where a divisor may pass through zero.
Interval bound(std::span<const Node> tree, Interval range, int pieces = 256);

/// The largest absolute value of bound(); infinite where a pole cannot be excluded.
double magnitude_bound(std::span<const Node> tree, Interval range, int pieces = 256);

/// Where in `range` a one-variable formula jumps: zeros of SIGN's arguments and of divisors at which the value really
/// changes by more than `smallest_jump`. Ascending; found on a grid of `grid` points and bisected.
std::vector<double> discontinuities(const Tree& tree, Interval range, double smallest_jump, int grid = 2048);

}  // namespace demecal
