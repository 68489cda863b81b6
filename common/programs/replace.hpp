// The text of a corrected program.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "programs/correct_program.hpp"

namespace demecal {

/// `text` with the cells of the program's targets replaced by their new texts; every other byte as it was.
std::string replaced(std::string_view text, const Program& program, const std::vector<CorrectedTarget>& targets);

}  // namespace demecal
