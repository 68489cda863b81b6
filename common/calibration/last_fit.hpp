// The last fit of a calibration: its choices made, the numbers come from all poses that had a part in choosing.
#pragma once

#include "calibration/closing.hpp"
#include "diagnosis/final_fit.hpp"

namespace demecal {

/// `robot` as a model whose corrections a fit leaves as they are.
DiagnosedModel with_corrections_kept(const DataSet& data, const DeclaredModel& declared, const Fit& fit,
                                     const CorrectedRobot& robot);

/// What the closed loop started from, and what it ended with.
struct LoopEnds {
  DiagnosedModel before, after;
};

/// Both fitted once more as final_fit() says, tidied; nothing where that would change neither.
std::optional<LoopEnds> fitted_at_last(const DataSet& data, const DeclaredModel& declared, LoopEnds ends);

/// rms of both over the validation poses, mm.
UnseenValidation unseen_validation(const DataSet& data, const LoopEnds& ends);

}  // namespace demecal
