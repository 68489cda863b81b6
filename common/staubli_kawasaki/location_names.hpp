// Names of locations in VAL II and in AS, which comes of it: "#p[1]" of joints, "p[1]" of a pose.
#pragma once

#include <cstddef>
#include <functional>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "parsed_programs/program.hpp"
#include "parsed_programs/program_text.hpp"

namespace demecal::inline staubli_kawasaki {

/// The name that begins at `begin` of the code, as written: a # before it and indices behind it belong to it; empty
/// where none does.
std::string location_name(const ProgramText& text, std::size_t begin, std::size_t end);
/// By which names are one: in small letters, without blanks.
std::string location_key(std::string_view name);
/// All names that stand in [begin, end), those of functions and words included.
std::vector<std::string> location_names(const ProgramText& text, std::size_t begin, std::size_t end);
/// Says in `program` where motions go to locations that are none of its targets; `why` gives a reason by the key, or
/// nothing. A computed index may be any of an array.
void note_untold_locations(const ProgramText& text, const std::map<std::string, std::vector<TargetUse>>& uses,
                           const std::function<std::string(const std::string&)>& why, Program& program);
/// Where the word, in small letters, stands in [begin, end); the end where it does not.
std::size_t find_word(const ProgramText& text, std::size_t begin, std::size_t end, std::string_view word);
/// Where the argument that begins at `begin` ends: a comma outside of parentheses, or `end`.
std::size_t end_of_argument(std::string_view code, std::size_t begin, std::size_t end);

}  // namespace demecal::inline staubli_kawasaki
