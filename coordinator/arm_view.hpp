// The arm of a data set and where it was measured, as an event for pages that draw it.
#pragma once

#include <string>

namespace demecal {

/// A line {"event": "arm", ...} (docs/FORMATS.md, monitor --http): the arm at poses spread over those measured, where
/// they were measured, and by how much the robot of the file (its base and tool fitted to the calibration poses) misses
/// them; where `model_file` names a model of it, by how much that misses them, too. Throws InputError where a file is
/// missing or invalid, or no position was measured.
std::string arm_event(const std::string& data_file, const std::string& model_file);

}  // namespace demecal
