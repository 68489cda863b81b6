// How large a formula can become over a range, by interval arithmetic, and where it jumps.
#pragma once

#include <span>
#include <vector>

#include "expression/tree.hpp"
#include "primitives/primitive.hpp"

namespace demecal::inline expression {

/// All values from lower to upper, both included; an infinite end means that nothing bounds that side.
struct Interval {
  double lower = 0.0;
  double upper = 0.0;

  bool operator==(const Interval&) const = default;
};

/// The whole real line.
Interval unbounded();
bool holds(const Interval& interval, double value);
/// The smallest interval that holds both.
Interval hull(const Interval& a, const Interval& b);

/// Every finite value of a function of one argument from `x`. Rounded outwards; a single point gives the single value
/// that evaluate() gives.
Interval image(Primitive function, const Interval& x);
/// Every finite value of a function of two arguments that vary independently; `%` is unbounded where its divisor may be
/// zero, unless the divisor is nothing but zero (1) or the dividend is (0 or 1).
Interval image(Primitive function, const Interval& left, const Interval& right);
/// Every finite value of a function of two equal arguments: x - x = 0, x % x = 1, and x * x is not negative.
Interval image_of_twins(Primitive function, const Interval& x);

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

/// Whether the interval of bound() on so many halved pieces of `range` as it takes, at most 2^halvings, lies within
/// -largest and largest: pieces are halved only where they do not. False where a pole cannot be excluded.
bool stays_within(std::span<const Node> tree, Interval range, double largest, int halvings = 8);

}  // namespace demecal::inline expression
