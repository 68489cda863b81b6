// What the data check sees once a model is there: smaller faults than the quick fit shows, and another frame.
#pragma once

#include "data_check/finding.hpp"
#include "effects/corrected_robot.hpp"

namespace demecal {

/// Adds the single poses (of all sets) that do not fit `robot`, a model of the data, to those that are named already.
/// Where all poses fit `robot` in another frame only, as those of a later measurement do, it says that and no more.
void check_fitted(const DataSet& data, const CorrectedRobot& robot, DataCheck& check);

}  // namespace demecal
