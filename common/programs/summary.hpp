// What was corrected, by how much, for people and for programs.
#pragma once

#include <string>
#include <vector>

#include "kinematics/chain.hpp"
#include "parsed_programs/program.hpp"
#include "programs/correct_program.hpp"
#include "programs/target_correction.hpp"

namespace demecal::inline programs {

struct TargetFigures {
  std::vector<std::string> names, units;               ///< q1 .., or x, y, z
  std::vector<double> nominal, corrected, difference;  ///< in these units
  double moved_mm = 0.0;                               ///< distance that the nominal robot's tool point is moved
  double turned_deg = 0.0;                             ///< angle that its tool is turned
};

/// Of a target that was corrected.
TargetFigures target_figures(const Target& target, const CorrectedTarget& corrected, const Chain& arm);

/// Mean and largest distance, mm, that corrections move the nominal robot's tool point, over the targets corrected.
struct MovedFigures {
  int targets = 0, uncorrected = 0;  ///< corrected (where nothing had to change, too), and left as they are
  int undetermined = 0;              ///< left as programmed, since the calibration does not determine the correction
  double mean_mm = 0.0, max_mm = 0.0;
};
MovedFigures moved_figures(const CorrectedProgram& corrected);

/// A table: nominal, corrected and difference of every target, then mean and largest.
std::string summary_table(const CorrectedProgram& corrected, const Chain& arm);

/// One JSON object on one line: `targets` in the order of the text with name, file, line, column, kind (joints or
/// pose), joints_from (see JointsFrom), frame and tool, units, nominal, corrected, difference, moved_mm,
/// predicted_error95_mm (radius that holds the real tool point 95 % of the time, without measurement noise; of models
/// that state it; it is twice standard_uncertainty_mm, and coverage_factor says so), widened_by (why
/// that radius is larger than where the arm was measured), left_as_programmed (sentences),
/// and of poses turned_deg; `moved_mm` mean and max; `left`, how many are as they were, for whatever reason; `notes`
/// (from where joints and poses are taken to count); `warnings` (line 0: of the whole program).
std::string summary_json(const CorrectedProgram& corrected, const Chain& arm);

/// "FILE:12: #cp[3]: SENTENCE", a line of its own; without the number where it is about the whole program.
std::string warning_text(const CorrectedProgram& corrected, const Remark& warning);

}  // namespace demecal::inline programs
