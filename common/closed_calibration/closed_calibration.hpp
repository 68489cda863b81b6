// A calibration with the closed loop around it: effects found, corrections evolved anew beside them, and again.
#pragma once

#include <optional>

#include "calibration/calibration.hpp"
#include "calibration/evolver.hpp"
#include "calibration/job.hpp"
#include "data/data_set.hpp"
#include "diagnosis/loop.hpp"
#include "diagnosis/outcome.hpp"
#include "prediction/corrected_robot.hpp"

namespace demecal::inline closed_calibration {

struct ClosedCalibration {
  CorrectedRobot before;              ///< what the loop started from: everything declared
  Calibration calibration;            ///< the model with the effects added; where none was, that of `before`
  std::optional<Calibration> best{};  ///< of the least error on the validation poses, where it has more causes
  LoopOutcome loop;                   ///< of all passes
};

/// Closes the loop around `first`, and where that has evolved corrections around the model without any too: the one
/// with the smaller error on the selection poses is kept. Where effects were added and joint corrections are declared,
/// the corrections are evolved anew from what the effects leave of the joints' errors; the evolved ones, the loop's own
/// smooth sums and the first ones compete on the selection poses, and the model with the smaller error there is kept.
/// Where that is the one evolved anew the loop looks at it again, at most three times in all. Where structure is left
/// that no effect explains, formulas over all that a joint's error may depend on are evolved on it, and compete in one
/// more pass. At the end the numbers are fitted once more, to the validation poses as well where there are accept poses
/// to tell the error by. Corrections are evolved anew by the job's method, with `functions` where joints share any.
/// Ends early when `watch` returns false.
ClosedCalibration close_calibration(const DataSet& data, const Job& job, const Preparation& preparation,
                                    const Calibration& first, Evolver& evolver, const RoundWatcher& watch,
                                    const KnownFunctions& functions = std::nullopt);

}  // namespace demecal::inline closed_calibration
