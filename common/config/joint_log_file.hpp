// Recordings of joints that a PREPARATION.yaml names under `log`, and those given by themselves.
#pragma once

#include <filesystem>
#include <vector>

#include "preparation/recorded_contacts.hpp"
#include "yaml/yaml_node.hpp"

namespace demecal::inline config {

/// The root of a PREPARATION.yaml, its keys and version checked.
YamlNode read_preparation(const std::filesystem::path& path);

/// Whether the contacts of recordings are asked for, in place of what an instrument measured.
bool names_recordings(const YamlNode& preparation);

/// Everything that stands under `log`, and the files it names, read. Columns that are not named are found by their
/// headings. Throws InputError with file, line, value and rule at the first fault in any of them.
Recordings load_recordings(const YamlNode& preparation);

/// The same of files alone.
Recordings load_recordings(const std::filesystem::path& robot, const std::vector<std::filesystem::path>& logs);

}  // namespace demecal::inline config
