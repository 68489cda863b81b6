// Effects as expressions, held within the ranges they were measured in.
#pragma once

#include <numbers>

#include "effects/symbolic_state.hpp"
#include "expression/bound.hpp"

namespace demecal::inline formulas {

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

/// As symbolic_units(), with the effect held, and faded, beyond the ranges it was measured in, as append_unit_motions()
/// does it.
std::vector<SymbolicUnit> held_units(const Effect& effect, const SymbolicState& state, const std::string& name);

}  // namespace demecal::inline formulas
