#include <Eigen/Core>
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <iterator>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "data/columns.hpp"
#include "data/data_set.hpp"
#include "data/text.hpp"
#include "data_files/data_set_file.hpp"
#include "data_files/pose_files.hpp"
#include "data_files/robot_file.hpp"
#include "errors/input_error.hpp"
#include "kinematics/units.hpp"
#include "random/random_stream.hpp"
#include "yaml/yaml_node.hpp"

namespace demecal::inline data_files {
namespace {

void read_anchors(const YamlNode* node, std::size_t distances, DataSet& data) {
  if (!node) return;
  data.anchors_unknown = node->kind == YamlNode::Kind::scalar && node->scalar == "unknown";
  if (data.anchors_unknown) return;
  if (node->kind != YamlNode::Kind::list) node->fail("must be `unknown` or a list of points");
  for (const YamlNode& point : node->list(distances)) data.anchors_m.push_back(metres(1.0) * point.vector3());
}

void require_anchors(const YamlNode& root, const ColumnMap& columns) {
  if (columns.distances.empty() || root.find("anchors_mm")) return;
  throw InputError(columns.distances.front().where, columns.distances.front().name,
                   "is a distance, but anchors_mm is missing: the fixed points of the distances, or `unknown`");
}

/// Where the instrument stands is known in its own frame alone.
void require_instrument_of_angles(const DataSet& data, const PosesOfFiles& read) {
  const ColumnMap& columns = read.columns;
  if (data.frame == Frame::sensor || !read.sigma_by_angles) return;
  throw InputError(
      columns.sigma[1].where, columns.sigma[1].name,
      "is an instrument's angle, but positions are in the robot's base frame, where its place is not known: "
      "give `frame: sensor`, or the uncertainties along x, y and z");
}

std::map<std::string, Eigen::Vector3d> read_tools(const YamlNode* node) {
  std::map<std::string, Eigen::Vector3d> tools_m;
  if (!node) return tools_m;
  if (node->kind != YamlNode::Kind::map) node->fail("must be a map of targets and their tool points");
  for (const YamlNode& tool : node->children) tools_m[tool.name] = metres(1.0) * tool.vector3();
  return tools_m;
}

struct SplitKeys {
  SplitFractions fractions;
  std::uint64_t seed = 1;
};

SplitKeys read_split(const YamlNode* node) {
  SplitKeys split;
  if (!node) return split;
  node->with_keys({"validation_fraction", "accept_fraction", "seed"});
  split.fractions.validation = node->at("validation_fraction").number(0.0, 1.0);
  if (const YamlNode* accept = node->find("accept_fraction")) split.fractions.accept = accept->number(0.0, 1.0);
  if (const YamlNode* seed = node->find("seed")) split.seed = seed->seed();
  if (split.fractions.validation + split.fractions.accept >= 1.0) {
    node->fail("", "leaves no poses for calibration: the fractions must sum to less than 1");
  }
  return split;
}

/// Takes the poses of these ids out of those that are used.
void exclude_poses(const YamlNode* ids, DataSet& data) {
  if (!ids) return;
  for (const YamlNode& id : ids->list()) {
    const std::string name = id.text();
    const auto named = [&name](const MeasuredPose& pose) { return pose.pose_id == name; };
    if (std::ranges::any_of(data.excluded, named)) id.fail(name, "is excluded already");
    if (std::ranges::none_of(data.poses, named)) {
      std::vector<std::string> names;
      for (const MeasuredPose& pose : data.poses) names.push_back(pose.pose_id);
      id.fail(name,
              "is the id of no pose" + (names.empty() ? "" : "; the nearest is '" + nearest_name(name, names) + "'"));
    }
    std::ranges::copy_if(data.poses, std::back_inserter(data.excluded), named);
    std::erase_if(data.poses, named);
  }
}

void read_columns(const YamlNode* node, std::vector<ColumnName>& columns) {
  if (!node) return;
  for (const YamlNode& item : node->list()) columns.push_back(read_column(item));
}

void read_columns(const YamlNode* node, std::optional<ColumnName>& column) {
  if (node) column = read_column(*node);
}

}  // namespace

ColumnName read_column(const YamlNode& node) {
  ColumnName name{node.text(), {node.file, node.line}};
  const bool number = !node.quoted && node.scalar.find_first_not_of("0123456789") == std::string::npos;
  if (number) name.number = static_cast<std::size_t>(node.whole_number(1, 10000));
  return name;
}

DataSet load_data_set(const std::filesystem::path& path) {
  return load_described_data_set(path).data;
}

DescribedDataSet load_described_data_set(const std::filesystem::path& path) {
  const YamlNode root = read_yaml(path);
  root.with_version("dataset", 1)
      .with_keys({"demecal_dataset", "name", "robot", "poses", "columns", "anchors_mm", "tools_mm", "contacts", "units",
                  "frame", "split", "exclude", "join", "certificate"});
  DataSet data;
  data.name = root.find("name") ? root.at("name").text() : path.stem().string();
  data.robot = read_named(root.at("robot"), load_robot);
  if (const YamlNode* frame = root.find("frame")) {
    data.frame = frame->one_of<Frame>({{"base", Frame::base}, {"sensor", Frame::sensor}});
  }
  const AssumedUnits units = read_units(root.find("units"));
  data.tools_m = read_tools(root.find("tools_mm"));
  const SplitKeys split = read_split(root.find("split"));

  PosesOfFiles read = read_pose_files(root, units, data.robot.chain, data.tools_m);
  require_anchors(root, read.columns);
  read_anchors(root.find("anchors_mm"), read.columns.distances.size(), data);
  data.file = std::move(read.file);
  data.sha256 = std::move(read.sha256);
  data.poses = std::move(read.poses);
  if (!read.columns.set) {
    RandomStream random{split.seed};
    split_by_pose(data.poses, split.fractions, [&random](std::size_t n) { return random.index(n); });
  }
  exclude_poses(root.find("exclude"), data);
  require_instrument_of_angles(data, read);
  weigh_by_stated_uncertainty(data);
  if (data.anchors_unknown) take_wires_for_contacts(data);
  read_contacts(root.find("contacts"), read.columns, data);
  if (const YamlNode* certificate = root.find("certificate")) read_certificate(*certificate);
  return {std::move(data), std::move(read.recognised)};
}

ColumnMap read_column_map(const YamlNode& node, ColumnsOf of) {
  std::vector<std::string> keys;
  ColumnMap::for_each_key([&](std::string_view key, auto) { keys.emplace_back(key); });
  node.with_keys(keys);
  ColumnMap map;
  map.where = {node.file, node.line};
  ColumnMap::for_each_key([&](std::string_view key, auto member) { read_columns(node.find(key), map.*member); });
  if (of == ColumnsOf::all) node.at("joints");
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

}  // namespace demecal::inline data_files
