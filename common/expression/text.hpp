// Formulas as text in the thesis's notation (theta, + - * %, SIN COS SIGN SQRTp, and later ones), written and read back
// to the bit.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "expression/shared_function.hpp"
#include "expression/tree.hpp"

namespace demecal {

/// Names of the variables by index; a joint's own correction knows one, "theta".
using VariableNames = std::vector<std::string>;
VariableNames theta_only();

/// Infix text whose parse gives the same tree back, to the bit: constants print with as many digits as they need, and
/// parentheses stand wherever precedence or order of evaluation would otherwise change (thesis note 24).
std::string to_text(std::span<const Node> tree, const VariableNames& names = theta_only());

/// The tree that `text` writes. `%` and `*` bind alike, from the left; unary minus stands only before a number.
/// Case counts; spaces do not. Calls of `functions`, F1 the first, become what they stand for. Throws InputError naming
/// the column (from 1) and what was expected there; also where parentheses nest deeper than 256, or calls come to more
/// than kLongestExpansion nodes.
Tree parse(std::string_view text, const VariableNames& names = theta_only(),
           std::span<const SharedFunction> functions = {});

}  // namespace demecal
