// Calibration by transforms between the links: searched for in this process, without workers.
#pragma once

#include "coordinator/calibrate.hpp"

namespace demecal {

/// Base, tool, offsets and geometry as the job declares them are fitted for comparison; the search starts from base and
/// tool alone. Interrupted, it keeps the best structure so far.
CalibrateResult calibrate_structurally(const DataSet& data, const Job& job, const std::atomic<bool>& interrupt,
                                       const CalibrateOptions& options);

}  // namespace demecal
