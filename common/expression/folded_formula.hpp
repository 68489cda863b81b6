// Formulas written with calls of shared functions, where that is shorter.
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "expression/shared_function.hpp"
#include "expression/text.hpp"

namespace demecal {

/// No deeper formula is written with calls: the texts of these nest no deeper than can be read.
inline constexpr int kDeepestFolded = 100;

struct FoldedCall;

/// A formula whose variables from `variables` on stand for calls: the first for calls[0].
struct FoldedFormula {
  Tree outline;
  int variables = 1;  ///< of the formula itself
  std::vector<FoldedCall> calls;
};

/// A call of one of a list's functions.
struct FoldedCall {
  std::size_t function = 0;           ///< its place in the list
  std::vector<FoldedFormula> places;  ///< coefficients, then arguments
};

/// The shortest way to write a formula of `variables` variables with calls of `functions`, whatever the order of
/// arguments that have none, and with constants either subtracted or their negatives added; without a call where none
/// makes it shorter, or where the formula is deeper than kDeepestFolded.
FoldedFormula folded(std::span<const Node> tree, std::span<const SharedFunction> functions, int variables = 1);

/// How many nodes and calls that way has.
std::size_t folded_size(std::span<const Node> tree, std::span<const SharedFunction> functions);
std::size_t size(const FoldedFormula& formula);

/// The places in the list of the functions that are called, ascending.
std::vector<std::size_t> functions_called(const FoldedFormula& formula);

/// The formula written out: in_order() of it is in_order() of the one that was folded.
Tree expanded(const FoldedFormula& formula, std::span<const SharedFunction> functions);

/// As to_text(), with calls such as F1(0.3, theta); parse() with the same functions gives what expanded() gives.
std::string to_text(const FoldedFormula& formula, const VariableNames& names = theta_only());

}  // namespace demecal
