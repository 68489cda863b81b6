// A target's numbers as summaries show them: in degrees and mm.
#pragma once

#include <string>
#include <vector>

#include "programs/correct_program.hpp"

namespace demecal {

struct TargetFigures {
  std::vector<std::string> names, units;               ///< q1 .., or x, y, z
  std::vector<double> nominal, corrected, difference;  ///< in these units
  double moved_mm = 0.0;                               ///< distance that the nominal robot's tool point is moved
  double turned_deg = 0.0;                             ///< angle that its tool is turned
};

/// Of a target that was corrected.
TargetFigures figures_of(const Target& target, const CorrectedTarget& corrected, const Chain& arm);

}  // namespace demecal
