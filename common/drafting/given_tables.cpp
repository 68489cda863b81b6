#include <Eigen/Core>
#include <algorithm>
#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "data/columns.hpp"
#include "data/csv.hpp"
#include "data/data_set.hpp"
#include "data/read_poses.hpp"
#include "drafting/draft_data_set.hpp"
#include "errors/input_error.hpp"
#include "kinematics/chain.hpp"
#include "kinematics/drawn_arm.hpp"
#include "tables/guess_columns.hpp"
#include "tables/layout.hpp"
#include "tables/read_table.hpp"
#include "yaml/files.hpp"

namespace demecal::inline drafting {

std::vector<GivenTable> read_given_tables(const std::vector<std::filesystem::path>& files, std::size_t joints,
                                          const ToldLayout& told, const std::vector<std::string>& joint_names) {
  std::vector<GivenTable> tables;
  for (const std::filesystem::path& path : files) {
    GivenTable& given = tables.emplace_back(GivenTable{path, read_table(read_file(path), path.string(), told), {}});
    const std::size_t count = joints > 0 ? joints : count_joint_columns(given.read.table);
    given.columns = guess_columns(given.read.table, count, joint_names);
  }
  return tables;
}

std::vector<std::string> joint_names(const Robot& robot) {
  std::vector<std::string> names;
  if (!robot.drawing) return names;
  for (const DrawnJoint& joint : robot.drawing->joints) names.push_back(joint.name);
  return std::ranges::count(names, std::string()) > 0 ? std::vector<std::string>{} : names;
}

DataSet read_pendant_poses(const std::filesystem::path& path, const Robot& robot) {
  const GivenTable given = read_given_tables({path}, robot.chain.joints.size(), {}, joint_names(robot)).front();
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
