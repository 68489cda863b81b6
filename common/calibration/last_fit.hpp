// The last fit of a calibration: its choices made, the numbers come from all poses that had a part in choosing.
#pragma once

#include "calibration/closing.hpp"
#include "diagnosis/loop.hpp"

namespace demecal {

/// `robot` as a model whose corrections a fit leaves as they are.
DiagnosedModel with_corrections_kept(const DataSet& data, const DeclaredModel& declared, const Fit& fit,
                                     const CorrectedRobot& robot);

/// What the closed loop started from, and what it ended with.
struct LoopEnds {
  DiagnosedModel before, after;
};

struct LastFit {
  LoopEnds ends;            ///< fitted once more as final_fit() says, tidied
  UnseenValidation unseen;  ///< of the ends before that
};

/// Nothing where it would change neither end.
std::optional<LastFit> last_fit(const DataSet& data, const DeclaredModel& declared, LoopEnds ends);

}  // namespace demecal
