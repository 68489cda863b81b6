#include "data_files/pose_files.hpp"

#include <algorithm>
#include <cstddef>
#include <filesystem>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "data/columns.hpp"
#include "data/csv.hpp"
#include "data/read_poses.hpp"
#include "data/text.hpp"
#include "data_files/data_set_file.hpp"
#include "errors/input_error.hpp"
#include "tables/read_table.hpp"
#include "yaml/files.hpp"

namespace demecal::inline data_files {
namespace {

/// The files that share columns, and which of them has a column.
class SharedFiles {
 public:
  explicit SharedFiles(std::vector<PoseFile>& files) {
    for (std::size_t i = 0; i < files.size(); ++i) {
      if (!files[i].own_columns) shared_.emplace_back(i, &files[i]);
    }
  }

  bool single() const { return shared_.size() == 1; }
  std::size_t first() const { return shared_.front().first; }

  /// Those with a column of that name; throws InputError where there are none.
  std::vector<std::pair<std::size_t, PoseFile*>> having(const ColumnName& name) const {
    if (name.number > 0) {
      throw InputError(name.where, std::to_string(name.number),
                       "is the number of a column, but of which file? Give each file its own `columns`");
    }
    std::vector<std::pair<std::size_t, PoseFile*>> found;
    std::vector<std::string> known;
    std::string files;
    for (const auto& [number, file] : shared_) {
      if (file->table.find(name.name)) found.emplace_back(number, file);
      known.insert(known.end(), file->table.columns.begin(), file->table.columns.end());
      files += (files.empty() ? "" : " and of ") + file->table.file;
    }
    if (!found.empty()) return found;
    throw InputError(name.where, name.name,
                     "is no column of " + files + "; the nearest is '" + nearest_name(name.name, known) + "'");
  }

  /// The one file with the column.
  std::size_t only(const ColumnName& name) const {
    if (single()) return first();
    const auto found = having(name);
    if (found.size() == 1) return found.front().first;
    throw InputError(name.where, name.name,
                     "is a column of " + found[0].second->table.file + " and of " + found[1].second->table.file +
                         ": which is meant? Give each file its own `columns`");
  }

 private:
  std::vector<std::pair<std::size_t, PoseFile*>> shared_;
};

/// What rows are joined by may stand in every file.
void set_keys(const SharedFiles& files, std::vector<PoseFile>& all, const std::optional<ColumnName>& name,
              std::optional<ColumnName> PoseFile::*key) {
  if (!name) return;
  if (files.single()) {
    (all[files.first()].*key) = *name;
    return;
  }
  for (const auto& [number, file] : files.having(*name)) (file->*key) = *name;
}

/// Several files may have these: their rows are joined by them.
bool joins_rows(std::string_view key) {
  return key == "pose" || key == "time";
}

void add_shared(std::vector<PoseFile>& files, const ColumnMap& shared, ColumnMap& map) {
  const SharedFiles where(files);
  ColumnMap::for_each_key([&](std::string_view key, auto member) {
    if (joins_rows(key)) return;
    for (ColumnName name : columns_in(shared.*member)) {
      name.table = where.only(name);
      add_column(map.*member, std::move(name));
    }
  });
  set_keys(where, files, shared.pose, &PoseFile::pose);
  set_keys(where, files, shared.time, &PoseFile::time);
}

void add_own(PoseFile& file, std::size_t table, ColumnMap& map) {
  ColumnMap::for_each_key([&](std::string_view key, auto member) {
    if (joins_rows(key)) return;
    for (ColumnName name : columns_in((*file.own_columns).*member)) {
      const auto others = columns_in(map.*member);
      if (!others.empty() && others.front().table != table) {
        throw InputError(name.where, name.name, "is given for another file too: a quantity must come from one file");
      }
      name.table = table;
      add_column(map.*member, std::move(name));
    }
  });
  file.pose = file.own_columns->pose;
  file.time = file.own_columns->time;
}

/// The key of the file preferred, or of the first that has it.
std::optional<ColumnName> preferred_key(const std::vector<PoseFile>& files, std::size_t preferred,
                                        std::optional<ColumnName> PoseFile::*key) {
  std::optional<ColumnName> found;
  for (std::size_t i = files.size(); i-- > 0;) {
    if (!(files[i].*key) || (found && found->table == preferred)) continue;
    found = files[i].*key;
    found->table = i;
  }
  return found;
}

}  // namespace

ColumnMap combined_columns(std::vector<PoseFile>& files, const std::optional<ColumnMap>& shared,
                           const InputError::Where& where) {
  ColumnMap map;
  map.where = shared ? shared->where : where;
  if (shared) {
    const auto no_own = [](const PoseFile& file) { return !file.own_columns; };
    if (std::ranges::none_of(files, no_own)) {
      throw InputError(shared->where, "", "columns serve files without columns of their own, and there are none");
    }
    add_shared(files, *shared, map);
  }
  for (std::size_t i = 0; i < files.size(); ++i) {
    if (files[i].own_columns) add_own(files[i], i, map);
  }
  const auto table_of = [](const std::vector<ColumnName>& names) { return names.empty() ? 0 : names.front().table; };
  map.pose = preferred_key(files, table_of(map.joints), &PoseFile::pose);
  map.time = preferred_key(files, table_of(map.position), &PoseFile::time);
  return map;
}

namespace {

/// An item of `poses`.
const YamlNode& file_node(const YamlNode& item) {
  if (item.kind == YamlNode::Kind::scalar) return item;
  return item.with_keys({"file", "delimiter", "decimal", "header_line", "columns"}).at("file");
}

const YamlNode* columns_node(const YamlNode& item) {
  return item.kind == YamlNode::Kind::map ? item.find("columns") : nullptr;
}

PoseFile read_pose_file(const YamlNode& item) {
  const YamlNode& name = file_node(item);
  const std::string bytes = read_named(name, read_file);
  PoseFile file;
  file.node = &item;
  RecognisedTable read = read_table(bytes, resolve(name.file, name.text()).string(), read_layout(item));
  file.table = std::move(read.table);
  file.found = std::move(read.found);
  file.sha256 = sha256(bytes);
  if (const YamlNode* own = columns_node(item)) file.own_columns = read_column_map(*own, ColumnsOf::part);
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

}  // namespace demecal::inline data_files
