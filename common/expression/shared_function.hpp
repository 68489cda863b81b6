// Functions that formulas of several joints share: one structure, called with other coefficients and arguments
// (thesis 7.1 ii; automatically defined functions, Koza 1994).
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "expression/tree.hpp"

namespace demecal::inline expression {

/// F(c1, c2, ..., a1, a2, ...): a formula without constants whose variables are places, those of coefficients first. A
/// coefficient is a number; an argument is any formula.
struct SharedFunction {
  Tree body;
  int coefficients = 0;

  bool operator==(const SharedFunction&) const = default;
};

inline constexpr std::size_t kMostSharedFunctions = 16;  ///< that formulas may share
inline constexpr std::size_t kLongestBody = 64;          ///< nodes of a function's body
/// Nodes that formulas written with calls may have when these are written out.
inline constexpr std::size_t kLongestExpansion = 65535;

/// Why this is no function, a rule that begins with "must": the body is no complete formula, has constants, more than
/// kLongestBody nodes or no function in it, leaves a place out, or has no argument beside its coefficients. Nothing
/// where it is one.
std::optional<std::string> find_fault(const SharedFunction& function);

/// How many coefficients and arguments a function takes, together.
int arity(const SharedFunction& function);

/// What a call stands for: the body with `places` in place of its variables, as many as the function's arity.
Tree expanded(const SharedFunction& function, std::span<const Tree> places);
/// How many nodes that is.
std::size_t expanded_size(const SharedFunction& function, std::span<const Tree> places);

/// F1, F2, ... by the function's place in a list, from 0.
std::string name_of_function(std::size_t place);

/// "F1(c1, c2, a1) = c1 * SIN(c2 + a1)" for the function at that place of a list.
std::string definition_text(const SharedFunction& function, std::size_t place);

/// The function that such a text defines at that place of a list. Throws InputError where the text is none, or what it
/// defines is no function.
SharedFunction parse_definition(std::string_view text, std::size_t place);

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

}  // namespace demecal::inline expression
