// FANUC .LS: what one instruction of a program is, whether it is a motion, and what it changes.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

#include "parsed_programs/changed_names.hpp"
#include "parsed_programs/program_text.hpp"

namespace demecal::inline languages {

/// Past the number of a line.
std::size_t after_line_number(std::string_view code, std::size_t begin);

/// Whether a motion begins there: "L P[3] ...", "J PR[1] ...".
bool is_fanuc_motion(std::string_view code, std::size_t begin);

/// "7" of "[7:up]" that opens at or after `begin`; empty where it is no number.
std::string bracketed_number(const ProgramText& text, std::size_t begin, std::size_t end);

/// The bracket that closes the one at `open`; `end` where none does.
std::size_t closing_bracket(std::string_view code, std::size_t open, std::size_t end);

/// Whether the first group of motion may be meant by "1", "GP1" or anything that is computed.
bool is_first_group(std::string_view group);

/// The number of a position whose bracket opens at `open`: 3 of [3] and of [3:name]; nothing, -1, where it is no
/// number.
int position_number(const ProgramText& text, std::size_t open);

/// Tells `changes` which positions, frames and tools an instruction, [begin, end) of the code, gives a value or
/// computes with.
void find_fanuc_changes(const ProgramText& text, std::size_t begin, std::size_t end, ChangedNames& changes);

}  // namespace demecal::inline languages
