// Several passes of the closed loop, with corrections and formulas evolved between them: joined to one outcome, and
// whether a model with evolved formulas takes the place of one without.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "calibration/job.hpp"
#include "data/data_set.hpp"
#include "diagnosis/candidates.hpp"
#include "diagnosis/outcome.hpp"
#include "prediction/corrected_robot.hpp"

namespace demecal::inline closed_calibration {

bool added_any(const LoopOutcome& outcome);

/// The rounds of both, numbered through; of everything else what `later` says, which looked last, save for what was
/// asked of the loop's start.
LoopOutcome joined(LoopOutcome earlier, LoopOutcome later);

/// The robot without formulas from outside the catalogue.
CorrectedRobot without_formulas(const CorrectedRobot& robot);

/// Whether evolution may find what the loop did not: formulas are wanted, and structure is left or a formula of the
/// library is in the model for want of a name.
bool needs_formula_search(const LoopOutcome& loop, const CorrectedRobot& robot, const ClosedLoopOptions& options);

/// The length of a robot's description of poses, nats: squared tool errors, their scatter free, and its effects at
/// their prices among `candidates`. The corrections are taken to cost nothing.
double description_nats(const CorrectedRobot& robot, const DataSet& data, std::span<const std::size_t> poses,
                        const std::vector<Candidate>& candidates);

/// Whether `robot` describes the calibration poses more shortly than `present` and its mean squared tool error on the
/// validation poses is not beyond that of `present` by more than two standard errors (paired, pose by pose).
bool describes_better(const CorrectedRobot& robot, const CorrectedRobot& present, const DataSet& data,
                      const std::vector<Candidate>& candidates);

/// Appends to `outcome` the rounds of a pass that added what `kept`, the model that was kept after all, does without.
void append_rejected_rounds(const LoopOutcome& pass, const CorrectedRobot& kept, LoopOutcome& outcome);

}  // namespace demecal::inline closed_calibration
