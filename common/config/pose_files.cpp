#include "config/pose_files.hpp"

#include <algorithm>
#include <cstddef>
#include <filesystem>
#include <functional>
#include <optional>
#include <utility>

#include "config/data_set_file.hpp"
#include "config/join_files.hpp"
#include "data/csv.hpp"
#include "data/read_poses.hpp"
#include "errors/input_error.hpp"
#include "tables/read_table.hpp"
#include "yaml/files.hpp"

namespace demecal::inline config {
namespace {

/// An item of `poses`.
const YamlNode& name_of(const YamlNode& item) {
  if (item.kind == YamlNode::Kind::scalar) return item;
  return item.with_keys({"file", "delimiter", "decimal", "header_line", "columns"}).at("file");
}

const YamlNode* columns_of(const YamlNode& item) {
  return item.kind == YamlNode::Kind::map ? item.find("columns") : nullptr;
}

PoseFile read_pose_file(const YamlNode& item) {
  const YamlNode& name = name_of(item);
  const std::string bytes = read_named(name, read_file);
  PoseFile file;
  file.node = &item;
  RecognisedTable read = read_table(bytes, resolve(name.file, name.text()).string(), read_layout(item));
  file.table = std::move(read.table);
  file.found = std::move(read.found);
  file.sha256 = sha256(bytes);
  if (const YamlNode* own = columns_of(item)) file.own_columns = read_column_map(*own, ColumnsOf::part);
  return file;
}

std::vector<PoseFile> read_files(const YamlNode& poses) {
  std::vector<PoseFile> files;
  if (poses.kind != YamlNode::Kind::list) {
    if (poses.kind != YamlNode::Kind::scalar) poses.fail("", "must be a file or a list of files");
    files.push_back(read_pose_file(poses));
    return files;
  }
  if (poses.list().empty()) poses.fail("", "must name one file at least");
  for (const YamlNode& item : poses.list()) files.push_back(read_pose_file(item));
  return files;
}

}  // namespace

ToldLayout read_layout(const YamlNode& node) {
  ToldLayout told;
  if (node.kind != YamlNode::Kind::map) return told;
  if (const YamlNode* delimiter = node.find("delimiter")) {
    told.delimiter = delimiter->one_of<Delimiter>({{"comma", Delimiter::comma},
                                                   {"semicolon", Delimiter::semicolon},
                                                   {"tab", Delimiter::tab},
                                                   {"blanks", Delimiter::blanks}});
  }
  if (const YamlNode* decimal = node.find("decimal"))
    told.decimal = decimal->one_of<char>({{"point", '.'}, {"comma", ','}});
  if (const YamlNode* header = node.find("header_line"))
    told.header_line = static_cast<std::size_t>(header->whole_number(0, 1000000));
  return told;
}

PosesOfFiles read_pose_files(const YamlNode& root, const AssumedUnits& units, const Chain& chain,
                             const std::map<std::string, Eigen::Vector3d>& tools_m) {
  std::vector<PoseFile> files = read_files(root.at("poses"));
  const YamlNode* shared = root.find("columns");
  const bool all_own = std::ranges::all_of(files, [](const PoseFile& file) { return file.own_columns.has_value(); });
  const std::optional<ColumnMap> columns =
      shared || !all_own
          ? std::optional(read_column_map(root.at("columns"), files.size() > 1 ? ColumnsOf::part : ColumnsOf::all))
          : std::nullopt;
  PosesOfFiles read;
  read.columns = combined_columns(files, columns, {root.file, root.line});
  check_column_map(read.columns, chain);
  std::vector<std::string> joined;
  const JoinedTables tables = join_files(root, files, read.columns, units, chain, joined);
  for (const PoseFile& file : files) {
    if (!file.found.empty()) read.recognised.push_back(file.table.file + ": " + file.found);
    read.sha256 += file.sha256;
  }
  read.recognised.insert(read.recognised.end(), joined.begin(), joined.end());
  if (files.size() > 1) read.sha256 = sha256(read.sha256);
  read.file = tables.tables[tables.main].file;
  read.poses = read_poses(tables, read.columns, units, chain, tools_m);
  read.sigma_by_angles = states_range_and_angles(tables.tables, read.columns);
  return read;
}

}  // namespace demecal::inline config
