#include "data_files/stated_sets.hpp"

#include <algorithm>

#include "yaml/files.hpp"
#include "yaml/yaml_node.hpp"

namespace demecal::inline data_files {
namespace {

bool names_sets(const YamlNode& holder) {
  const YamlNode* columns = holder.kind == YamlNode::Kind::map ? holder.find("columns") : nullptr;
  return columns != nullptr && columns->find("set") != nullptr;
}

}  // namespace

bool states_sets(const std::filesystem::path& data_set_file) {
  const YamlNode root = read_yaml(data_set_file);
  const YamlNode* files = root.find("poses");
  return root.find("split") != nullptr || names_sets(root) ||
         (files != nullptr && std::ranges::any_of(files->children, names_sets));
}

}  // namespace demecal::inline data_files
