// Where a program says what the arm carries, and how much that is.
#pragma once

#include <vector>

#include "parsed_programs/language.hpp"
#include "parsed_programs/program.hpp"
#include "parsed_programs/program_text.hpp"

namespace demecal::inline languages {

/// The lines that begin, behind blanks and a line's number, with a statement that sets the payload.
std::vector<PayloadStatement> payload_statements_of(const Language& language, const ProgramSource& source);

}  // namespace demecal::inline languages
