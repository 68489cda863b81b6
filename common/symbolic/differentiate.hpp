// The exact derivative of an expression, as an expression.
#pragma once

#include <string>

#include "symbolic/algebra.hpp"

namespace demecal {

/// d expression / d symbol. Steps (sign, round) have derivative 0, and at a kink the derivative is the mean of those
/// beside it. Protected quotients and roots give 0 where their divisor or argument is 0.
Expression derivative(Expression expression, const std::string& symbol);

}  // namespace demecal
