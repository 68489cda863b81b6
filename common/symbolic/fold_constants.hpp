// Values of functions, and functions whose arguments say enough.
#pragma once

#include <optional>
#include <span>

#include "symbolic/algebra.hpp"

namespace demecal {

/// The value of a function (not an evolved formula) at the values of its arguments.
double value_of(Function function, std::span<const double> arguments);

/// The expression that a function of such arguments comes to without being called; nothing where it must be called.
std::optional<Expression> folded(Function function, const std::vector<Expression>& arguments);

}  // namespace demecal
