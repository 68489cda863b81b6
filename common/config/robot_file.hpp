// Robot files: the arm as its maker describes it.
#pragma once

#include <filesystem>
#include <string>

#include "config/yaml_node.hpp"
#include "data/data_set.hpp"

namespace demecal {

/// The robot of a ROBOT.yaml. Throws InputError with file, line, value and rule at the first fault.
Robot load_robot(const std::filesystem::path& path);

/// The same of a map already read, such as one inside another file; its version key is the caller's to check.
Robot robot_from(const YamlNode& node);

/// The keys of a ROBOT.yaml but its version, one or more lines each, every line moved `indent` spaces to the right.
/// robot_from() reads them back.
std::string robot_text(const Robot& robot, int indent = 0);

}  // namespace demecal
