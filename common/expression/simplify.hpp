// Shorter formulas of the same value.
#pragma once

#include "expression/tree.hpp"

namespace demecal {

/// The formula without what changes no value, to the bit but for the sign of zero, wherever all its subtrees are
/// finite: functions of constants become constants; a - a is 0, a % a and a % 0 are 1 (as % is protected), terms of 0
/// and factors and divisors of 1 go, products with 0 are 0, a + a is 2 * a where that is shorter, and functions that
/// change nothing after others go, such as ABS(SQRTp(a)). Never longer, and valid for the same variables.
Tree simplified(const Tree& tree);

}  // namespace demecal
