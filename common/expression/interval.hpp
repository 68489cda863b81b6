// Intervals that surely hold every value a primitive takes over intervals.
#pragma once

#include "expression/primitive.hpp"

namespace demecal {

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

}  // namespace demecal
