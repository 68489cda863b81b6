// Distal learning of all joints at once, in rounds: each joint against what the others left in the round before.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "calibration/calibration.hpp"
#include "calibration/distal_steps.hpp"
#include "calibration/evolver.hpp"

namespace demecal {

/// The calibration poses' index of the preparation's declared robot, lowered round by round. In every round all joints
/// evolve for their share of job.gp's generations against the linearised index, from populations that hold the fronts
/// of the round before; then the model takes candidates (see take_candidates), so that its exact index never rises.
/// Ends with the rounds, or where evolution is cut off. Where the job has joints share functions, these are the known
/// ones or, without any such list, found anew after every round. A function of data, job and what `evolver` finds.
DistalOutcome learn_in_rounds(const DistalIndex& index, const Preparation& preparation, const Job& job,
                              Evolver& evolver, const KnownFunctions& known = std::nullopt);

/// The outcome's candidates: of every training's joint what is best of each length among `trees`, by the table against
/// what the final model leaves, and the model's own correction.
void offer_for_choice(const DistalIndex& index, const std::vector<JointTraining>& trainings,
                      const std::vector<std::vector<Tree>>& trees, DistalOutcome& outcome);

}  // namespace demecal
