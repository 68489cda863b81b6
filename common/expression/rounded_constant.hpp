// Constants of formulas that people read.
#pragma once

namespace demecal::inline expression {

/// The value with so many significant digits; as it is where it has none (0, or not finite) or is smaller than powers
/// of ten reach.
double rounded_constant(double value, int digits);

}  // namespace demecal::inline expression
