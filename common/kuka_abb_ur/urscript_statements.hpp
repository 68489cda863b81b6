// Universal Robots URScript: literals and arguments, where variables are given what no reader can follow, and rotation
// vectors that cannot be meant in rad.
#pragma once

#include <cstddef>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "parsed_programs/given_numbers.hpp"
#include "parsed_programs/program.hpp"
#include "parsed_programs/program_text.hpp"

namespace demecal::inline kuka_abb_ur {

/// How many of its first arguments a command moves to; 0 for words that are none.
int urscript_targets(std::string_view word);

/// Where a literal [...] or p[...] begins at or after `offset`, if that and nothing else is the value there.
std::optional<std::size_t> urscript_literal(const ProgramText& text, std::size_t offset);

/// What the variables of a program are given, wherever that stands.
struct UrScriptVariables {
  std::map<std::string, std::vector<std::size_t>> literals{};  ///< where each is given one
  std::set<std::string> computed{};    ///< those that are given anything else, or an element of it
  std::set<std::string> parameters{};  ///< of functions

  /// The literal of a variable that is given this one and nothing else.
  std::optional<std::size_t> only_literal(const std::string& name) const;
  /// Those of a variable with literals that the motion at `motion` may go to.
  std::vector<std::size_t> literals_at(const std::string& name, std::size_t motion, const FrameFlow& way) const;

  GivenNumbers given;
};
UrScriptVariables urscript_variables(const ProgramText& text);

/// The parenthesis that closes the one at `open`; nothing where none does.
std::optional<std::size_t> urscript_close(const ProgramText& text, std::size_t open);

/// Past "NAME =", where the argument is given by name.
std::size_t urscript_argument(const ProgramText& text, std::size_t offset);
/// The comma or parenthesis that ends the argument at `offset`.
std::size_t urscript_argument_end(const ProgramText& text, std::size_t offset);

/// Marks the targets of variables that are also given anything but numbers, and of those that stand anywhere but where
/// motions, features and tools take them (`plain`, by offset), and are not copied to another either.
void mark_changed(const ProgramText& text, const std::set<std::size_t>& plain, std::vector<Target>& targets);

/// Why the rotation vector of a pose cannot be meant in rad; empty: it can.
std::string longer_than_a_turn(const Target& target);

}  // namespace demecal::inline kuka_abb_ur
