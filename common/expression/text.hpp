// Formulas as text in the thesis's notation (theta, + - * %, SIN COS SIGN SQRTp, and later ones), written and read back
// to the bit.
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "expression/shared_function.hpp"
#include "expression/tree.hpp"

namespace demecal::inline expression {

/// Parentheses within each other that parsers take: they call themselves, and text comes from strangers.
inline constexpr int kDeepestNesting = 256;

/// How tightly infix text binds; whole: a terminal, a call, or anything in parentheses.
enum class Precedence { sum, product, whole };
struct InfixText {
  std::string text;
  Precedence precedence = Precedence::whole;
};

/// Names of the variables by index; a joint's own correction knows one, "theta".
using VariableNames = std::vector<std::string>;
VariableNames theta_only();

/// Infix text whose parse gives the same tree back, to the bit: constants print with as many digits as they need, and
/// parentheses stand wherever precedence or order of evaluation would otherwise change (thesis note 24).
std::string to_string(std::span<const Node> tree, const VariableNames& names = theta_only());

/// As to_string(), with calls such as F1(0.3, theta); parse() with the same functions gives what expanded() gives.
std::string to_string(const FoldedFormula& formula, const VariableNames& names = theta_only());

/// The tree that `text` writes. `%` and `*` bind alike, from the left; unary minus stands only before a number.
/// Case counts; spaces do not. Calls of `functions`, F1 the first, become what they stand for. Throws InputError naming
/// the column (from 1) and what was expected there; also where parentheses nest deeper than 256, or calls come to more
/// than kLongestExpansion nodes.
Tree parse(std::string_view text, const VariableNames& names = theta_only(),
           std::span<const SharedFunction> functions = {});

/// Throws the InputError that shows the beginning of `text`, names the column of its character `position` (from 0;
/// shown from 1), and says what was expected there.
[[noreturn]] void throw_syntax_error(std::string_view text, std::size_t position, const std::string& expected);

}  // namespace demecal::inline expression
