#include "calibration/distal_learning.hpp"

#include "calibration/distal_rounds.hpp"
#include "calibration/distal_sequence.hpp"

namespace demecal {

DistalOutcome learn_distally(const DataSet& data, const Job& job, const Preparation& preparation, Evolver& evolver,
                             const KnownFunctions& known) {
  const DistalIndex index(data, preparation.targets.poses, preparation.declared);
  if (job.distal.form == DistalForm::parallel) return learn_in_rounds(index, preparation, job, evolver, known);
  SequenceOutcome outcome = learn_in_sequence(index, preparation, job, [&] { return !evolver.is_interrupted(); });
  evolver.add_effort(outcome.generations, outcome.evaluations);
  outcome.learnt.is_complete = !evolver.is_interrupted();
  return std::move(outcome.learnt);
}

}  // namespace demecal
