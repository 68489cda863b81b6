// Shorter formulas of the same value.
#pragma once

#include <vector>

#include "expression/tree.hpp"

namespace demecal {

/// The formula without what changes no value, to the bit but for the sign of zero, wherever all its subtrees are
/// finite: functions of constants become constants; a - a is 0, a % a and a % 0 are 1 (as % is protected), terms of 0
/// and factors and divisors of 1 go, products with 0 are 0, a + a is 2 * a where that is shorter, and functions that
/// change nothing after others go, such as ABS(SQRTp(a)). Never longer, and valid for the same variables.
Tree simplified(const Tree& tree);

/// The same with terms collected wherever that makes it shorter: 2 * a - a * 3 is -1 * a. Its values differ by what
/// other roundings make of them, which is much where a divisor or the argument of a SIGN is all but zero.
Tree collected(const Tree& tree);

/// collected() if over `columns` (as many as the formula's variables) its values stay within `tolerance` times the
/// formula's largest size there, else simplified().
Tree simplified_over(const Tree& tree, const std::vector<std::vector<double>>& columns, double tolerance = 1e-9);

}  // namespace demecal
