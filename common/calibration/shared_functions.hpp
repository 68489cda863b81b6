// Joints that share functions (thesis 7.1 ii): evolution in stages, between which functions are made of what the
// joints' good formulas have in common.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "calibration/evolver.hpp"
#include "calibration/job.hpp"
#include "calibration/selection.hpp"
#include "calibration/training.hpp"
#include "expression/shared_function.hpp"
#include "expression/tree.hpp"
#include "prediction/corrected_robot.hpp"

namespace demecal::inline calibration {

/// A joint's formulas that are described in the fewest nats together with the errors they leave on its table, taken as
/// of Laplace's law for absolute and normal for squared errors; simplified, no two equal, the best first.
std::vector<Tree> good_formulas(const JointCandidates& candidates);

/// Functions that the good formulas of two joints or more have in common (see find_shared_functions()), as many as the
/// options allow at most.
std::vector<SharedFunction> shared_functions(std::span<const JointCandidates> candidates,
                                             const SharingOptions& options);

struct StagedOutcome {
  std::vector<JointCandidates> candidates;  ///< of every joint the best of each length over all stages
  std::vector<SharedFunction> functions;    ///< that the last stage had
};

/// Evolves in as many stages as the job says, of equally many generations. The first is as if there were no others; in
/// each that follows calls of functions may stand in what is made at random, and first populations hold the fittest of
/// the joint's front. Ends with what was reached where evolution is cut off. A function of training, job and what
/// `evolver` finds.
StagedOutcome learn_in_stages(const std::vector<JointTraining>& training, const Job& job, Evolver& evolver);

/// A correction's formula, g(theta) in rad, with calls of the functions where these make it shorter; without any where
/// there are no functions.
FoldedFormula folded_correction(const JointCorrection& correction, const KnownFunctions& functions);

/// The joints, from 0 and ascending, whose corrections call the function at that place.
std::vector<int> joints_calling(const CorrectedRobot& robot, const std::vector<SharedFunction>& functions,
                                std::size_t place);

}  // namespace demecal::inline calibration
