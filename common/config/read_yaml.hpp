// A YAML file as nodes that know their lines.
#pragma once

#include <filesystem>
#include <string>

#include "config/yaml_node.hpp"

namespace demecal {

/// The one document of the file. Throws InputError where the file cannot be read, is no YAML, is empty, holds several
/// documents, or a map has a key twice.
YamlNode read_yaml(const std::filesystem::path& path);

/// The same for text already read; `file` names it in errors.
YamlNode parse_yaml(const std::string& text, const std::string& file);

}  // namespace demecal
