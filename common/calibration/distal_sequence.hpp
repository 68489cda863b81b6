// Distal learning of one joint at a time: the co-evolutionary algorithm of the thesis's Figure 4-6.
#pragma once

#include <cstdint>
#include <functional>

#include "calibration/calibration.hpp"
#include "calibration/distal_steps.hpp"

namespace demecal {

struct SequenceOutcome {
  DistalOutcome learnt;
  std::uint32_t generations = 0;  ///< of all joints together
  std::uint64_t evaluations = 0;
};

/// The calibration poses' index of the preparation's declared robot, lowered by the thesis's algorithm with one
/// population a joint: the joint of the greatest compensation potential (eq. 4.11) is bred until the exact index falls;
/// the model takes its fittest formula, and the joint is selected anew. A population that does not gain for 40
/// generations begins anew around its fittest (as in the thesis's program). Formulas are ranked by the index linearised
/// about the present model, which differs from the exact one by parts in a thousand of what a correction changes. What
/// would be the fittest but is not bounded (see is_bounded) loses its fitness. Ends after job.gp.number_generations in
/// all, or when `may_go_on`, asked before every generation, says no. Where the job has amplitudes fitted (the thesis
/// does not), those of all joints are fitted to one another after every step. A function of data and job.
SequenceOutcome learn_in_sequence(const DistalIndex& index, const Preparation& preparation, const Job& job,
                                  const std::function<bool()>& may_go_on);

}  // namespace demecal
