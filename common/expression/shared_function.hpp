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

namespace demecal {

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

}  // namespace demecal
