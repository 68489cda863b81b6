// The way that the instructions of a Yaskawa job tell: branches, loops, labels, jumps and calls.
#pragma once

#include <cstddef>

#include "languages/labelled_way.hpp"
#include "parsed_programs/program_text.hpp"

namespace demecal::inline languages {

/// Takes one instruction, [begin, end) of the text without blanks around.
void read_job_way(const ProgramText& text, std::size_t begin, std::size_t end, LabelledWay& way);

}  // namespace demecal::inline languages
