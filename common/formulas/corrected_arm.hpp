// A model as formulas of its joints alone: where each joint really goes, and where that puts the tool.
#pragma once

#include "effects/corrected_robot.hpp"
#include "symbolic/code.hpp"

namespace demecal::inline formulas {

/// The formulas, and what the model knows beyond them.
struct CorrectedArm {
  std::vector<Expression> actual;  ///< q + g(q) of each joint, of the symbol q1 .. qn
  SymbolicMatrix pose;             ///< of the tool in the measurements' frame, of q1 .. qn and actual1 .. actualn
  std::vector<std::string> notes;  ///< sentences: effects that are left out, or taken at some circumstance
};

/// The model's prediction at a stop of which nothing but the joints is known: no payload, no approach, no warmth and no
/// time. The expressions live in `algebra`. The robot must have the target.
CorrectedArm corrected_arm(Algebra& algebra, const CorrectedRobot& robot, const std::string& target);

/// The listing of the formulas with the remarks that a reader needs: what it is, units, frames, and the notes.
Listing listing_of(const CorrectedArm& arm, const CorrectedRobot& robot, const std::string& title);

}  // namespace demecal::inline formulas
