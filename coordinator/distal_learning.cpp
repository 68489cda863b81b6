#include "coordinator/distal_learning.hpp"

#include "calibration/distal_sequence.hpp"

namespace demecal {

DistalOutcome learn_distally(const DataSet& data, const Job& job, const Preparation& preparation,
                             Evolutions& evolutions, const KnownFunctions& known) {
  const DistalIndex index(data, preparation.targets.poses, preparation.declared);
  if (job.distal.form == DistalForm::sequential) {
    SequenceOutcome outcome = learn_in_sequence(index, preparation, job, [&] { return !evolutions.is_interrupted(); });
    evolutions.note_own(outcome.generations, outcome.evaluations);
    return std::move(outcome.learnt);
  }
  const EvolveRound evolve = [&](const std::vector<JointTraining>& training, const RoundTerms& terms) {
    std::optional<std::vector<JointCandidates>> candidates = evolutions.run(training, terms);
    if (evolutions.end() != RunEnd::finished) candidates.reset();
    return candidates;
  };
  return learn_in_rounds(index, preparation, job, evolve, known);
}

}  // namespace demecal
