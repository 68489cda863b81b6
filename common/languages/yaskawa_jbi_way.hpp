// Instructions of a Yaskawa job: the way that they tell (branches, loops, labels, jumps and calls), and arguments.
#pragma once

#include <cstddef>

#include "languages/labelled_way.hpp"
#include "parsed_programs/program_text.hpp"

namespace demecal::inline languages {

/// Takes one instruction, [begin, end) of the text without blanks around.
void read_job_way(const ProgramText& text, std::size_t begin, std::size_t end, LabelledWay& way);

/// Whether the instruction's first argument is a position whose number is computed: "ADD P[I000] P010".
bool names_computed_position(const ProgramText& text, std::size_t begin, std::size_t end);

}  // namespace demecal::inline languages
