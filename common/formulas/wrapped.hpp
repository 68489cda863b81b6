// Angles held on one branch and values held within a range, as expressions.
#pragma once

#include <numbers>

#include "expression/bound.hpp"
#include "symbolic/algebra.hpp"

namespace demecal {

/// As wrap_near().
inline Expression wrapped_near(Expression angle, double centre_rad) {
  constexpr double kTurn = 2.0 * std::numbers::pi;
  const Expression turns = (1.0 / kTurn) * (angle - centre_rad);
  return angle - kTurn * angle.algebra().function(Function::round, {turns});
}

/// The nearest value of the range.
inline Expression held_within(Expression value, const Interval& range) {
  Algebra& algebra = value.algebra();
  return smaller(larger(value, algebra.constant(range.lower)), algebra.constant(range.upper));
}

}  // namespace demecal
