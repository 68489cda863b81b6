// What functions, sums and products of expressions come to: values of constants, and theorems of sines and cosines.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "symbolic/algebra.hpp"

namespace demecal::inline symbolic {

/// The value of a function (not an evolved formula) at the values of its arguments.
double value_of(Function function, std::span<const double> arguments);

/// The expression that a function of such arguments comes to without being called; nothing where it must be called.
std::optional<Expression> folded(Function function, const std::vector<Expression>& arguments);

/// The sine or cosine of an angle: exact at right angles, right angles within a sum taken out of it, and its first term
/// not negative. Where nothing of that applies, nothing.
std::optional<Expression> simplified_trigonometric(Function function, Expression angle);

/// first + ratio * second, ratio +1 or -1, where a theorem of sines and cosines makes one term of it.
std::optional<Expression> joined(Expression first, Expression second, double ratio);

/// 1 + ratio * term likewise.
std::optional<Expression> combined_with_one(Expression term, double ratio);

/// Bases and exponents of a product; of anything else, itself once.
std::vector<Part> factors_of(Expression expression);

}  // namespace demecal::inline symbolic
