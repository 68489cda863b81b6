#include <Eigen/Core>
#include <algorithm>
#include <cstddef>
#include <filesystem>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "data/columns.hpp"
#include "data/csv.hpp"
#include "data/data_set.hpp"
#include "data/read_poses.hpp"
#include "data/text.hpp"
#include "drafting/draft_data_set.hpp"
#include "errors/input_error.hpp"
#include "kinematics/chain.hpp"
#include "kinematics/drawn_arm.hpp"
#include "tables/guess_columns.hpp"
#include "tables/layout.hpp"
#include "tables/read_table.hpp"
#include "tables/time_stamp.hpp"
#include "yaml/files.hpp"

namespace demecal::inline drafting {
namespace {

/// The column's fields, where they are texts, most of which differ, and neither numbers nor times alone, which may be
/// the same in all tables too; otherwise nothing.
std::set<std::string> point_names(const CsvTable& table, std::size_t column) {
  std::set<std::string> names;
  bool numbers = true, times = true;
  for (const CsvRow& row : table.rows) {
    const std::string& field = row.fields[column];
    if (field.empty()) return {};
    names.insert(field);
    numbers = numbers && parse_number(field).has_value();
    times = times && parse_time_stamp(field).has_value();
  }
  return numbers || times || 2 * names.size() <= table.rows.size() ? std::set<std::string>{} : names;
}

/// Whether most of the fewer names are among the others.
bool names_match(const std::set<std::string>& some, const std::set<std::string>& others) {
  const std::set<std::string>&fewer = some.size() < others.size() ? some : others,
        &more = &fewer == &some ? others : some;
  const auto shared = std::ranges::count_if(fewer, [&more](const std::string& name) { return more.contains(name); });
  return !fewer.empty() && 2 * static_cast<std::size_t>(shared) > fewer.size();
}

/// Columns that hold the same names in all tables name the points, whatever they are called.
void find_names(std::vector<GivenTable>& tables) {
  const auto is_named = [](const GivenTable& given) { return given.columns.pose.has_value(); };
  if (tables.size() < 2 || std::ranges::all_of(tables, is_named)) return;
  const CsvTable& first = tables.front().read.table;
  for (std::size_t column = 0; column < first.columns.size(); ++column) {
    const std::set<std::string> names = point_names(first, column);
    std::vector<std::size_t> columns{column};
    for (std::size_t other = 1; other < tables.size() && !names.empty(); ++other) {
      const CsvTable& table = tables[other].read.table;
      for (std::size_t at = 0; at < table.columns.size() && columns.size() <= other; ++at)
        if (names_match(names, point_names(table, at))) columns.push_back(at);
    }
    if (columns.size() != tables.size()) continue;
    for (std::size_t i = 0; i < tables.size(); ++i) tables[i].columns.pose = columns[i];
    return;
  }
}

}  // namespace

bool most_names_agree(const std::vector<GivenTable>& tables) {
  if (!std::ranges::all_of(tables, [](const GivenTable& given) { return given.columns.pose.has_value(); }))
    return false;
  const std::set<std::string> first = point_names(tables.front().read.table, *tables.front().columns.pose);
  return std::ranges::all_of(tables, [&](const GivenTable& given) {
    return names_match(first, point_names(given.read.table, *given.columns.pose));
  });
}

std::vector<GivenTable> read_given_tables(const std::vector<std::filesystem::path>& files, std::size_t joints,
                                          const ToldLayout& told, const std::vector<std::string>& joint_names,
                                          std::size_t rails) {
  std::vector<GivenTable> tables;
  for (const std::filesystem::path& path : files) {
    GivenTable& given = tables.emplace_back(GivenTable{path, read_table(read_file(path), path.string(), told), {}});
    const std::size_t count = joints > 0 ? joints : count_joint_columns(given.read.table);
    given.columns = guess_columns(given.read.table, count, joint_names, rails);
  }
  find_names(tables);
  return tables;
}

std::size_t leading_rails(const Chain& chain) {
  return static_cast<std::size_t>(
      std::ranges::find_if(chain.joints, [](const Joint& joint) { return is_revolute(joint); }) - chain.joints.begin());
}

std::vector<std::string> joint_names(const Robot& robot) {
  std::vector<std::string> names;
  if (!robot.drawing) return names;
  for (const DrawnJoint& joint : robot.drawing->joints) names.push_back(joint.name);
  return std::ranges::count(names, std::string()) > 0 ? std::vector<std::string>{} : names;
}

DataSet read_pendant_poses(const std::filesystem::path& path, const Robot& robot) {
  const GivenTable given =
      read_given_tables({path}, robot.chain.joints.size(), {}, joint_names(robot), leading_rails(robot.chain)).front();
  const CsvTable& table = given.read.table;
  const auto named = [&](const std::vector<std::size_t>& group) {
    std::vector<ColumnName> names;
    for (const std::size_t column : group) names.push_back({table.columns[column], {path.string(), 0}, column + 1});
    return names;
  };
  if (given.columns.joints.empty() || given.columns.position.empty())
    throw InputError({path.string(), table.header_line}, "",
                     "needs a column for each of the " + std::to_string(robot.chain.size()) +
                         " joints (q1 ..., j1 ..., A1 ...) and the positions that the controller shows (x, y, z)");
  ColumnMap columns;
  columns.where = {path.string(), table.header_line};
  columns.joints = named(given.columns.joints);
  columns.position = named(given.columns.position);
  DataSet data;
  data.name = path.stem().string();
  data.file = path.string();
  data.robot = robot;
  data.frame = Frame::base;
  data.poses = read_poses(table, columns, {find_unit("deg"), find_unit("mm")}, robot.chain, {});
  return data;
}

}  // namespace demecal::inline drafting
