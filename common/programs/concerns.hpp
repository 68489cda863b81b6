// What a person should know of a target and its correction before running it.
#pragma once

#include <string>
#include <vector>

#include "programs/correct_program.hpp"

namespace demecal {

/// A sentence for each thing that is not as it should be; none where all is well.
std::vector<std::string> concerns(const Target& target, const CorrectedTarget& corrected, const CommandModel& model);

/// The same of the program, as read, as a whole, such as a tool that was identified far from where it is described.
/// `tool_given`: the model's tool is one that the user names.
std::vector<std::string> concerns(const Program& program, const CommandModel& model, bool tool_given = false);

}  // namespace demecal
