// links[].inertia_kgm2 of a ROBOT.yaml: read and written beside the robot, which does not hold them.
#pragma once

#include <Eigen/Core>
#include <filesystem>
#include <optional>
#include <string>

#include "data/data_set.hpp"
#include "data/link_inertia.hpp"
#include "yaml/yaml_node.hpp"

namespace demecal::inline data_files {

/// What an item of `links` states; nothing where it states none. Throws InputError with file, line, value and rule
/// where no body has such an inertia, or the link has no mass.
std::optional<Eigen::Matrix3d> read_link_inertia(const YamlNode& link);

/// Of all links of the file, which load_robot() has taken; empty where it states no inertia.
LinkInertias load_link_inertias(const std::filesystem::path& path);

/// robot_text() with them.
std::string robot_text(const Robot& robot, const LinkInertias& inertias, int indent = 0);

}  // namespace demecal::inline data_files
