// What depends on the side that joints come from where that is not known.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <functional>
#include <string>
#include <vector>

#include "parsed_programs/program.hpp"
#include "programs/command_model.hpp"
#include "programs/correct_program.hpp"
#include "programs/followed_motions.hpp"
#include "programs/target_correction.hpp"

namespace demecal::inline programs {

/// Whether a joint that comes from another side stops elsewhere.
bool depends_on_sides(const CommandModel& model);

/// Corrects all targets; where the corrections turn joints against the sides that they were to come from, again without
/// those sides. Returns the visits, and marks the targets in `turned`.
TargetVisits corrected_by_sides(
    const Program& program, const CommandModel& model, const Circumstances& circumstances,
    const std::function<CorrectedTarget(std::size_t, const std::vector<TargetVisit>&)>& correct,
    std::vector<CorrectedTarget>& corrected, std::vector<bool>& turned);

/// How far apart the real tool point may stand, m, by the sides of the joints whose approach at the stop is 0.
double unknown_side_m(const CommandModel& model, const CorrectedTarget& corrected);

/// Targets that are corrected for the middle between sides, and what depends on it.
struct UnknownSides {
  std::vector<const Target*> targets{};
  double most_m = 0.0;
};

/// Adds the target, unless the radius that the model states without it is more than what the side may leave, half of
/// what depends on it: a smaller part of the predicted error is in that figure, and needs no warning.
void note_unknown_side(const Target& target, const CorrectedTarget& corrected, UnknownSides& sides);

/// Why the side is not known of targets that are marked there.
constexpr const char* kTurnedBackWords =
    "is not sure, since the correction turns a joint back that the program itself holds or hardly moves";

/// "the side that the arm comes from ... at line 3, line 8 and 4 more". `why` is what is the matter with the side.
std::string unknown_side_sentence(const Program& program, const UnknownSides& sides, const std::string& why);

}  // namespace demecal::inline programs
