// Data sets and robots as files that load back to the same values.
#pragma once

#include <filesystem>
#include <string>

#include "data/data_set.hpp"

namespace demecal {

/// Writes ROBOT.yaml; `purpose` becomes its first, commented line. Throws InputError where the file cannot be written.
void write_robot(const Robot& robot, const std::filesystem::path& path, const std::string& purpose);

/// Writes dataset.yaml, poses.csv and robot.yaml into the folder, which is made if need be, and returns the path of
/// dataset.yaml. All poses must have the same quantities measured. `purpose` as above.
std::filesystem::path write_data_set(const DataSet& data, const std::filesystem::path& folder,
                                     const std::string& purpose);

}  // namespace demecal
