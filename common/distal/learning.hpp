// Distal learning: joint corrections from the error of the whole model, of all joints at once in rounds, or of one
// joint at a time by the co-evolutionary algorithm of the thesis's Figure 4-6.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

#include "calibration/calibration.hpp"
#include "calibration/evolver.hpp"
#include "calibration/job.hpp"
#include "calibration/selection.hpp"
#include "calibration/training.hpp"
#include "data/data_set.hpp"
#include "distal/index.hpp"
#include "distal/steps.hpp"
#include "expression/tree.hpp"

namespace demecal::inline distal {

/// Learns by distal supervision (thesis 4.3, 4.4) in the form that the job asks for, from where `preparation` stands,
/// over its targets' poses. What comes out is what was reached. `functions` are those that the joints share;
/// without any list, those that it finds, where the job asks for any.
DistalOutcome learn_distally(const DataSet& data, const Job& job, const Preparation& preparation, Evolver& evolver,
                             const KnownFunctions& functions = std::nullopt);

/// The calibration poses' index of the preparation's declared robot, lowered round by round. In every round all joints
/// evolve for their share of job.gp's generations against the linearized index, from populations that hold the fronts
/// of the round before; then the model takes candidates (see accept_candidates), so that its exact index never rises.
/// Ends with the rounds, or where evolution is cut off. Where the job has joints share functions, these are the known
/// ones or, without any such list, found anew after every round. A function of data, job and what `evolver` finds.
DistalOutcome learn_in_rounds(const DistalIndex& index, const Preparation& preparation, const Job& job,
                              Evolver& evolver, const KnownFunctions& functions = std::nullopt);

/// Fits joints to one another that learnt each by itself, as alternatives for the choice between corrections, over the
/// calibration poses' index: what a model without corrections takes of all candidates together, amplitudes fitted (see
/// accept_candidates); and, twice, what the choice then keeps, amplitudes fitted to one another.
void add_choices_of_all_joints(const DataSet& data, const Preparation& preparation,
                               std::vector<JointCandidates>& candidates);

/// The outcome's candidates: of every training's joint what is best of each length among `trees`, by the table against
/// what the final model leaves, and the model's own correction.
void gather_candidates(const DistalIndex& index, const std::vector<JointTraining>& trainings,
                       const std::vector<std::vector<Tree>>& trees, DistalOutcome& outcome);

struct SequenceOutcome {
  DistalOutcome learnt;
  std::uint32_t generations = 0;  ///< of all joints together
  std::uint64_t evaluations = 0;
};

/// The calibration poses' index of the preparation's declared robot, lowered by the thesis's algorithm with one
/// population a joint: the joint of the greatest compensation potential (eq. 4.11) is bred until the exact index falls;
/// the model takes its fittest formula, and the joint is selected anew. A population that does not gain for 40
/// generations begins anew around its fittest (as in the thesis's program). Formulas are ranked by the index linearized
/// about the present model, which differs from the exact one by parts in a thousand of what a correction changes. What
/// would be the fittest but is not bounded (see is_bounded) loses its fitness. Ends after job.gp.number_generations in
/// all, or when `may_go_on`, asked before every generation, says no. Where the job has amplitudes fitted (the thesis
/// does not), those of all joints are fitted to one another after every step. A function of data and job.
SequenceOutcome learn_in_sequence(const DistalIndex& index, const Preparation& preparation, const Job& job,
                                  const std::function<bool()>& may_go_on);

}  // namespace demecal::inline distal
