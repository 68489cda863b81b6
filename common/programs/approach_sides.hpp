// What depends on the side that joints come from where that is not known.
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "parsed_programs/program.hpp"
#include "programs/command_model.hpp"
#include "programs/correct_program.hpp"
#include "programs/target_correction.hpp"

namespace demecal::inline programs {

/// How far apart the real tool point may stand, m, by the sides of the joints whose approach at the stop is 0.
double unknown_side_m(const CommandModel& model, const CorrectedTarget& corrected);

/// Targets that are corrected for the middle between sides, and what depends on it.
struct UnknownSides {
  std::vector<const Target*> targets{};
  double most_m = 0.0;
};

/// "the side that the arm comes from ... at line 3, line 8 and 4 more". `why` is what is the matter with the side.
std::string unknown_side_sentence(const Program& program, const UnknownSides& sides, const std::string& why);

}  // namespace demecal::inline programs
