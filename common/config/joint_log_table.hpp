// A recording of joints as loggers write it, read: columns by name or by their headings, times in any form.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "data/data_set.hpp"
#include "preparation/joint_log.hpp"
#include "yaml/yaml_node.hpp"

namespace demecal::inline config {

/// What is said of one log.
struct LogRequest {
  std::filesystem::path path;
  const YamlNode* node = nullptr;  ///< a map with `set`, `columns`, `units` and the layout; null: nothing is said
};

/// Times count from `origin_s`, which becomes the first of the log where it is nothing yet. `assumed` gets what was
/// taken for granted, for people. Throws InputError with file, line, value and rule at the first fault.
JointLog read_joint_log(const LogRequest& request, const Robot& robot, std::optional<double>& origin_s,
                        std::vector<std::string>& assumed);

}  // namespace demecal::inline config
