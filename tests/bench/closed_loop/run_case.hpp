// One case from its plan to its figures: the clean twin, the effect drawn by it, and what the closed loop made of it.
#pragma once

#include <map>

#include "case_plan.hpp"
#include "score.hpp"

namespace demecal::bench {

/// What one run of the loop left.
struct LoopFigures {
  Score score;
  double before_over_floor = 0.0;  ///< rms of the accept poses over that of their noise, before the loop
  double after_over_floor = 0.0;
  int accept = 0, within = 0;  ///< accept poses, and those within the radius that is to hold 95 % of them
  std::vector<Round> rounds;
  std::vector<Effect> final_effects;
  double seconds = 0.0;
};

struct CaseFigures {
  CasePlan plan;
  std::vector<Effect> truths;  ///< empty: nothing of the kind can be seen, and the case does not count
  LoopFigures clean;           ///< of the twin without the effect
  LoopFigures run;
};

/// Robots by file name.
using Robots = std::map<std::string, Robot>;

/// `only_clean` leaves the effect's own run out.
CaseFigures run_case(const CasePlan& plan, const Robots& robots, bool only_clean);

}  // namespace demecal::bench
