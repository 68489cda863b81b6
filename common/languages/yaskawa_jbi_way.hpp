// Instructions of a Yaskawa job: the way that they tell (branches, loops, labels, jumps and calls), and arguments.
#pragma once

#include <cstddef>
#include <map>
#include <string>
#include <string_view>
#include <utility>

#include "languages/labelled_way.hpp"
#include "parsed_programs/program_text.hpp"

namespace demecal::inline languages {

/// Takes one instruction, [begin, end) of the text without blanks around.
void read_job_way(const ProgramText& text, std::size_t begin, std::size_t end, LabelledWay& way);

/// Whether the instruction's first argument is a position whose number is computed: "ADD P[I000] P010".
bool names_computed_position(const ProgramText& text, std::size_t begin, std::size_t end);

/// Whether the job does not only go from line to line.
bool job_jumps(const ProgramText& text);

/// Of an instruction behind which motions are shifted (SFTON, COMARCON), in small letters: the one that ends it, and
/// why what is moved to is then left. Both empty: it is none.
std::pair<std::string, std::string> job_shift(std::string_view word);
/// Those of the whole job.
std::map<std::string, std::string> all_job_shifts(const ProgramText& text);

}  // namespace demecal::inline languages
