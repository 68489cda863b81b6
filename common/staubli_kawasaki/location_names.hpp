// Names of locations in VAL II and in AS, which comes of it: "#p[1]" of joints, "p[1]" of a pose.
#pragma once

#include <cstddef>
#include <functional>
#include <map>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "parsed_programs/program.hpp"
#include "parsed_programs/program_text.hpp"

namespace demecal::inline staubli_kawasaki {

/// The name that begins at `begin` of the code, as written: a # before it and indices behind it belong to it; empty
/// where none does.
std::string location_name(const ProgramText& text, std::size_t begin, std::size_t end);
/// By which names are one: in small letters, without blanks.
std::string location_key(std::string_view name);
/// All names that stand in [begin, end), those of functions and words included; what is quoted has none.
std::vector<std::string> location_names(const ProgramText& text, std::size_t begin, std::size_t end);
/// Says in `program` where motions go to locations that are none of its targets; `why` gives a reason by the key, or
/// nothing. A computed index may be any of an array.
void note_untold_locations(const ProgramText& text, const std::map<std::string, std::vector<TargetUse>>& uses,
                           const std::function<std::string(const std::string&)>& why, Program& program);
/// Says in `program` that the target is a tool or base of the program, which it stays, where motions go to it, too.
void leave_frame(const Target& target, const std::vector<TargetUse>& motions, Program& program);
/// Why targets are left of a program that lets sensors alter its motions.
inline constexpr const char* kAltered =
    "the program lets motions be altered while they run (ALTER), and where it does is not followed";
/// Statements that are none of those known, where they stand, and the locations that each may move to: its arguments.
using UnknownStatements = std::vector<std::pair<std::size_t, std::string>>;
/// Adds the statement at `statement`, whose arguments are [begin, end), for those that are nothing but a name.
void add_unknown_statement(const ProgramText& text, std::size_t statement, std::size_t begin, std::size_t end,
                           UnknownStatements& statements);
/// What is known of the joints ends at those that are given one of the program's targets.
void end_at_unknown_statements(const UnknownStatements& statements, Program& program);
/// Where the word, in small letters, stands in [begin, end); the end where it does not.
std::size_t find_word(const ProgramText& text, std::size_t begin, std::size_t end, std::string_view word);
/// Where the argument that begins at `begin` ends: a comma outside of parentheses, or `end`.
std::size_t end_of_argument(std::string_view code, std::size_t begin, std::size_t end);

}  // namespace demecal::inline staubli_kawasaki
