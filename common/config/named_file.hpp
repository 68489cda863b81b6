// Files that a YAML file names.
#pragma once

#include "config/files.hpp"
#include "config/yaml_node.hpp"

namespace demecal {

/// What `read` makes of the path that the node names, relative to the node's file. Throws InputError at the node where
/// there is no such file.
template <typename Read>
auto read_named(const YamlNode& node, const Read& read) {
  const std::filesystem::path path = resolve(node.file, node.text());
  std::error_code ignored;
  if (!std::filesystem::exists(path, ignored)) node.fail(path.string(), "names a file that does not exist");
  return read(path);
}

}  // namespace demecal
