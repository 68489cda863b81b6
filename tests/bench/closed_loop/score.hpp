// How one run of the closed loop did against the truth.
#pragma once

#include <string>
#include <vector>

#include "diagnosis/outcome.hpp"

namespace demecal::bench {

struct Score {
  bool named = false;     ///< the first effect added is true; of pairs, both truths were added; of none, nothing was
  bool eligible = false;  ///< no rival by another name has a cosine of 0.9 with the first effect added
  bool in_class =
      false;  ///< named, or the truth is among the first one's rivals; of pairs, among those of any added one
  int false_additions = 0;  ///< effects of the final model that are not true
};

/// `final_effects` are those of the model the loop ended with; no truth: a clean case.
Score score(const LoopOutcome& outcome, const std::vector<Effect>& final_effects, const std::vector<Effect>& truths,
            const Robot& robot, const std::vector<ArmState>& states);

/// The first round that added an effect; null where none did.
const Round* first_added(const LoopOutcome& outcome);

/// "coupling joint 3 from 2", for people.
std::string words(const Effect& effect, const Robot& robot);

}  // namespace demecal::bench
