// What of a robot file looks like radians or metres where degrees and millimetres are expected.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace demecal::inline data_files {

/// A sentence each, with file, line and value, of a file that load_robot() accepts: limits of a joint that turns by
/// less than a whole turn of radians, limits of one that slides, lengths of links and a tool point of less than 2 mm
/// that are not 0. Any of them may be so; what fits an arm in metres is said.
std::vector<std::string> doubtful_units(const std::filesystem::path& robot_file);

}  // namespace demecal::inline data_files
