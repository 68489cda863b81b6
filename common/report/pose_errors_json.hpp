// Pose errors and their intervals as JSON, as reports and `evaluate --json` have them.
#pragma once

#include <nlohmann/json.hpp>

#include "report/pose_errors.hpp"

namespace demecal {

/// A list, in the data's order; what is not known is null.
nlohmann::ordered_json pose_errors_to_json(const std::vector<PoseErrorLine>& lines);

/// Where the radii come from.
nlohmann::ordered_json prediction_to_json(const PredictionInterval& interval);

}  // namespace demecal
