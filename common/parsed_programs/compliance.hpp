// Statements behind which the arm gives way to forces: its motions may end beside what they are sent to.
#pragma once

#include <cstddef>
#include <string>

#include "parsed_programs/program.hpp"
#include "parsed_programs/program_text.hpp"

namespace demecal::inline parsed_programs {

/// Says in `program` that from the statement at `begin` on, up to `end`, targets are corrected as if the arm did not
/// give way; what is known of the joints ends there. Both are what the program calls them.
void note_compliance(const ProgramText& text, std::size_t begin, const std::string& statement, const std::string& end,
                     Program& program);

}  // namespace demecal::inline parsed_programs
