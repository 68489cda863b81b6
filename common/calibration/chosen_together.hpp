// Corrections of all joints chosen together: which of every joint's candidates, and how large beside the others.
#pragma once

#include <cstddef>
#include <span>

#include "calibration/selection.hpp"
#include "data/data_set.hpp"
#include "fitting/declared_model.hpp"
#include "fitting/fit.hpp"

namespace demecal::inline calibration {

/// Targets of a pose's joints belong together, and what a joint learnt alone is too large or too small beside what the
/// others learnt. Here errors are taken to be linear in the corrections and in the declared numbers; for every set of
/// at most one candidate a joint, a factor of each is fitted to the `fitted` poses together with the declared numbers.
/// That set is taken which, with the errors that it leaves at the `fitted` and the `selecting` poses, is described in
/// the fewest nats (description_length_nats() of rows of both; formulas are paid for once), found by exchanging one
/// joint's candidate at a time, from no correction and from the last candidate of every joint. Then corrections leave,
/// the least sure first, until each that stays lowers the errors of both lists of poses by more than two standard
/// errors (pose by pose), all else fitted again without it. Nothing is taken whose factor is beyond 0.1 to 10, or that
/// becomes larger than the joint's limit. `start` is the model beside which the candidates were evolved, and how its
/// rows scatter; the selection's robot has its numbers still, and is best fitted again.
Selection choose_together(const DataSet& data, const DeclaredModel& declared, std::span<const std::size_t> fitted,
                          std::span<const std::size_t> selecting, const Fit& start,
                          std::span<const JointCandidates> candidates);

}  // namespace demecal::inline calibration
