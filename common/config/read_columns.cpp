#include "config/read_columns.hpp"

namespace demecal {
namespace {

ColumnName read_column(const YamlNode& node) {
  return {node.text(), {node.file, node.line}};
}

std::vector<ColumnName> read_columns(const YamlNode* node) {
  std::vector<ColumnName> columns;
  if (node) {
    for (const YamlNode& item : node->list()) columns.push_back(read_column(item));
  }
  return columns;
}

std::optional<ColumnName> read_single(const YamlNode* node) {
  if (!node) return std::nullopt;
  return read_column(*node);
}

}  // namespace

ColumnMap read_column_map(const YamlNode& node) {
  node.with_keys({"joints", "position", "orientation", "distances", "approach", "payload", "temperature", "time", "set",
                  "pose", "target"});
  ColumnMap map;
  map.where = {node.file, node.line};
  map.joints = read_columns(&node.at("joints"));
  map.position = read_columns(node.find("position"));
  map.orientation = read_columns(node.find("orientation"));
  map.distances = read_columns(node.find("distances"));
  map.approach = read_columns(node.find("approach"));
  map.payload = read_single(node.find("payload"));
  map.temperature = read_single(node.find("temperature"));
  map.time = read_single(node.find("time"));
  map.set = read_single(node.find("set"));
  map.pose = read_single(node.find("pose"));
  map.target = read_single(node.find("target"));
  return map;
}

AssumedUnits read_units(const YamlNode* node) {
  AssumedUnits units;
  if (!node) return units;
  node->with_keys({"angle", "length"});
  if (const YamlNode* angle = node->find("angle")) {
    units.angle = find_unit(angle->one_of<std::string_view>({{"deg", "deg"}, {"rad", "rad"}}));
  }
  if (const YamlNode* length = node->find("length")) {
    units.length = find_unit(length->one_of<std::string_view>({{"mm", "mm"}, {"m", "m"}}));
  }
  return units;
}

}  // namespace demecal
