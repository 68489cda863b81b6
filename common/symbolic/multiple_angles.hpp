// Sines and cosines of multiples of one angle, as the harmonics of a gear have them, computed from those of the angle.
#pragma once

#include <vector>

#include "symbolic/algebra.hpp"
#include "symbolic/printing.hpp"

namespace demecal::inline symbolic {

/// As plan_steps(), but sines and cosines of whole multiples of an angle take no further calls where there are several:
/// steps such as cos50_q1 come first. They are off by some multiple * 1e-16.
Steps plan_steps_with_multiples(const std::vector<Expression>& expressions, const ExpressionPrinter& printer);

}  // namespace demecal::inline symbolic
