// The last fit: every choice made, the numbers of a model come from all poses that had a part in choosing it.
#pragma once

#include "diagnosis/diagnosed_model.hpp"

namespace demecal {

/// The poses of the last fit: calibration and validation poses where there are accept poses to tell the error by,
/// calibration poses alone where there are none.
std::vector<std::size_t> poses_of_last_fit(const DataSet& data);

/// The same model, its effects as they were chosen, with its numbers at their least-squares values over
/// poses_of_last_fit(data), and its effects and smooth terms known over these poses' range. What the poses then say of
/// it is no longer unseen, but for the accept poses.
DiagnosedModel final_fit(const DataSet& data, const DeclaredModel& declared, DiagnosedModel model);

}  // namespace demecal
