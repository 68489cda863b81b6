// Several passes of the closed loop, with the joint corrections evolved anew between them, told as one.
#pragma once

#include "diagnosis/outcome.hpp"

namespace demecal {

bool added_any(const LoopOutcome& outcome);

/// The rounds of both, numbered through; of everything else what `later` says, which looked last, save for what was
/// asked of the loop's start.
LoopOutcome joined(LoopOutcome earlier, LoopOutcome later);

/// Makes the rounds tell of the model that is left: added effects with their values in it; those that are no longer in
/// it were not added after all.
void tell_of(LoopOutcome& outcome, const CorrectedRobot& model, const Robot& described);

}  // namespace demecal
