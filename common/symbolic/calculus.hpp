// The values of expressions where their symbols have values, and their exact derivatives.
#pragma once

#include <map>
#include <span>
#include <string>
#include <vector>

#include "symbolic/algebra.hpp"

namespace demecal::inline symbolic {

using SymbolValues = std::map<std::string, double>;

/// One value per expression (of one algebra); what they share is computed once. Every symbol in them must have a value.
std::vector<double> values_of(std::span<const Expression> expressions, const SymbolValues& symbols);
double value_of(Expression expression, const SymbolValues& symbols);

/// All terms that the expressions are made of, themselves included, a part always before what it is part of.
std::vector<Expression> terms_of(std::span<const Expression> expressions);

/// d expression / d symbol. Steps (sign, round) have derivative 0, and at a kink the derivative is the mean of those
/// beside it. Protected quotients and roots give 0 where their divisor or argument is 0.
Expression derivative(Expression expression, const std::string& symbol);

}  // namespace demecal::inline symbolic
