// Formulas made from a formula: shorter ones of the same value, and its derivative.
#pragma once

#include <cstdint>
#include <vector>

#include "expression/tree.hpp"

namespace demecal::inline expression {

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

/// d tree / d variable, simplified only where that keeps every finite value. SIGN has derivative 0, ABS(x) has
/// SIGN(x) * x', EXPb is cut off and MIN and MAX are chosen between by SIGN, SQRTp(x) has
/// SIGN(x) * (x' % (SQRTp(x) + SQRTp(x))) and f % g has SIGN(g) * ((f' - f % g * g') % (SIGN(g) * g)): by the leading
/// SIGN they are 0 wherever % and SQRTp are constant because their argument is 0 throughout. Where a formula jumps, its
/// derivative is that of the pieces beside the jump; at the point of the jump itself it has some finite value.
Tree derivative(const Tree& tree, std::uint8_t variable);

}  // namespace demecal::inline expression
