#include "data/columns.hpp"
#include "data/csv.hpp"
#include "data/read_poses.hpp"
#include "data_files/join_clocks.hpp"
#include "data_files/pose_files.hpp"
#include "errors/input_error.hpp"
#include "kinematics/chain.hpp"
#include "yaml/yaml_node.hpp"

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <functional>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "data/text.hpp"
#include "kinematics/forward.hpp"
#include "kinematics/units.hpp"
#include "tables/join.hpp"
#include "tables/time_stamp.hpp"

namespace demecal::inline data_files {
namespace {

constexpr double kStandingStill = 3.5e-4;  ///< rad or m between neighbouring rows of a log

std::vector<CsvTable> tables_of(const std::vector<PoseFile>& files) {
  std::vector<CsvTable> tables;
  for (const PoseFile& file : files) tables.push_back(file.table);
  return tables;
}

JoinRule read_rule(const YamlNode& node) {
  node.with_keys({"by", "within_s", "offset_s", "unmatched"});
  JoinRule rule;
  rule.by = node.at("by").one_of<JoinBy>({{"name", JoinBy::name}, {"order", JoinBy::order}, {"time", JoinBy::time}});
  if (const YamlNode* unmatched = node.find("unmatched")) {
    rule.unmatched = unmatched->one_of<Unmatched>({{"refuse", Unmatched::refuse}, {"leave_out", Unmatched::leave_out}});
    if (rule.by == JoinBy::order) unmatched->fail("says nothing where rows are joined by their order");
  }
  for (const char* key : {"within_s", "offset_s"}) {
    const YamlNode* found = node.find(key);
    if (found && rule.by != JoinBy::time) found->fail("says nothing where rows are not joined by time");
  }
  if (rule.by == JoinBy::time) rule.within_s = node.at("within_s").positive();
  if (const YamlNode* offset = node.find("offset_s")) {
    const bool automatic = offset->kind == YamlNode::Kind::scalar && offset->scalar == "auto";
    rule.offset_s = automatic ? std::nullopt : std::optional(offset->number());
  }
  return rule;
}

/// The file whose rows are poses: the one with what was measured.
std::size_t leading_file(const ColumnMap& columns) {
  for (const auto* group : {&columns.position, &columns.distances, &columns.orientation}) {
    if (!group->empty()) return group->front().table;
  }
  return 0;
}

std::vector<JoinKeys> pose_names(const std::vector<PoseFile>& files, const YamlNode& by) {
  std::vector<JoinKeys> keys;
  for (const PoseFile& file : files) {
    const TableColumn column(file.table, key_column(file, file.pose, "pose", by));
    JoinKeys& names = keys.emplace_back();
    for (const CsvRow& row : file.table.rows) {
      if (column.text(row).empty()) column.fail(row, "is empty where the name of a point is expected");
      names.names.push_back(column.text(row));
    }
  }
  return keys;
}

std::vector<TableColumn> quantities(const PoseFile& file, const std::vector<ColumnName>& names, const Chain* chain,
                                    const AssumedUnits& units) {
  std::vector<TableColumn> columns;
  for (std::size_t i = 0; i < names.size(); ++i)
    columns.emplace_back(file.table, names[i], chain ? joint_quantity(chain->joints[i]) : Quantity::length, units);
  return columns;
}

template <typename Vector>
std::vector<Vector> vectors_of(const PoseFile& file, const std::vector<TableColumn>& columns) {
  std::vector<Vector> all;
  for (const CsvRow& row : file.table.rows) {
    Vector values(static_cast<Eigen::Index>(columns.size()));
    for (std::size_t i = 0; i < columns.size(); ++i) values[static_cast<Eigen::Index>(i)] = columns[i].number(row);
    all.push_back(std::move(values));
  }
  return all;
}

std::vector<JointVector> joint_vectors(const PoseFile& file, const ColumnMap& columns, const AssumedUnits& units,
                                       const Chain& chain) {
  return vectors_of<JointVector>(file, quantities(file, columns.joints, &chain, units));
}

/// A join by time, with its clocks' offset found where it is not known.
class TimeJoin {
 public:
  TimeJoin(const YamlNode& node, std::vector<PoseFile>& files, const ColumnMap& columns, const AssumedUnits& units,
           const Chain& chain)
      : node_(node), files_(files), columns_(columns), units_(units), chain_(chain) {}

  JoinedRows run(const JoinRule& rule, std::vector<std::string>& sentences) {
    const std::size_t lead = leading_file(columns_), arm = columns_.joints.front().table;
    const std::vector<JoinKeys> keys = times_of(files_, lead, node_.at("by"), units_, rule, sentences);
    const ClockOffset offset =
        rule.offset_s ? ClockOffset{.offset_s = *rule.offset_s} : found_offset(keys, lead, arm, rule.within_s);
    JoinedRows joined = join_by_time(tables_of(files_), keys, lead, rule, offset.offset_s);
    if (!rule.offset_s) joined.sentence += in_words(offset);
    if (arm != lead) warn_of_motion(joined, keys[arm], arm, rule.within_s, sentences);
    return joined;
  }

 private:
  static std::string millimetres_text(double metres_value) {
    return number_text(std::round(1e2 * millimetres(metres_value)) / 1e2) + " mm";
  }

  std::string in_words(const ClockOffset& offset) const {
    std::string text = ", its clock " + number_text(std::round(1e3 * offset.offset_s) / 1e3) +
                       " s ahead (found by the arm's motion: arm and points then agree to " +
                       millimetres_text(offset.misfit_m);
    if (std::isfinite(offset.rival_m))
      text += ", and to " + millimetres_text(offset.rival_m) + " at the best offset that gives other joints";
    if (offset.tool_m)
      text += "; the tool was fitted for it, " + millimetres_text((*offset.tool_m - chain_.tool_m).norm()) +
              " from where the robot file has it";
    return text + ")";
  }

  ClockOffset found_offset(const std::vector<JoinKeys>& keys, std::size_t lead, std::size_t arm,
                           double within_s) const {
    if (files_.size() != 2 || columns_.position.empty() || arm == lead)
      node_.at("offset_s").fail("needs one file with joints and one with positions; give a number");
    JoinPoints points;
    points.measured_m =
        vectors_of<Eigen::Vector3d>(files_[lead], quantities(files_[lead], columns_.position, nullptr, units_));
    for (const JointVector& joints : joint_vectors(files_[arm], columns_, units_, chain_))
      points.flanges.push_back(forward(chain_, joints));
    points.tool_m = chain_.tool_m;
    return find_offset(files_[lead].table, keys[lead], files_[arm].table, keys[arm], points, within_s);
  }

  /// How far apart rows are neighbours, at the least: a log's next row tells of motion however near rows must be to
  /// be joined; over a gap of the log it tells nothing.
  static double neighbours_s(const JoinKeys& keys) {
    constexpr double kSteps = 1.5;
    std::vector<double> steps;
    for (std::size_t row = 1; row < keys.times_s.size(); ++row)
      steps.push_back(std::abs(keys.times_s[row] - keys.times_s[row - 1]));
    if (steps.empty()) return 0.0;
    const auto middle = steps.begin() + static_cast<std::ptrdiff_t>(steps.size() / 2);
    std::ranges::nth_element(steps, middle);
    return kSteps * *middle;
  }

  /// A measurement taken while the arm moves is off by its speed times what the clocks differ by.
  void warn_of_motion(const JoinedRows& joined, const JoinKeys& keys, std::size_t arm, double within_s,
                      std::vector<std::string>& sentences) const {
    const std::vector<JointVector> joints = joint_vectors(files_[arm], columns_, units_, chain_);
    constexpr std::size_t kDense = 5;  // rows a pose: fewer may be one row of each pose, between which the arm moved
    const bool dense = joints.size() >= kDense * joined.rows.size();
    const double near_s = dense ? std::max(within_s, neighbours_s(keys)) : within_s;
    std::size_t moving = 0, first_line = 0;
    for (const auto& pose : joined.rows) {
      const std::size_t row = pose[arm];
      const auto moves = [&](std::size_t other) {
        return other < joints.size() && std::abs(keys.times_s[other] - keys.times_s[row]) <= near_s &&
               (joints[other] - joints[row]).cwiseAbs().maxCoeff() > kStandingStill;
      };
      if (!moves(row + 1) && !(row > 0 && moves(row - 1))) continue;
      if (moving++ == 0) first_line = files_[arm].table.rows[row].line;
    }
    if (moving == 0) return;
    sentences.push_back(
        files_[arm].table.file + ":" + std::to_string(first_line) + ": the arm moves at " + std::to_string(moving) +
        " of " + std::to_string(joined.rows.size()) +
        " measured times (this is the first): its joints are then not those of the measurement. "
        "Measure while the arm stands; if it stood, the clocks differ: give their `offset_s` under `join`");
  }

  const YamlNode& node_;
  std::vector<PoseFile>& files_;
  const ColumnMap& columns_;
  const AssumedUnits& units_;
  const Chain& chain_;
};

}  // namespace

JoinedTables join_files(const YamlNode& root, std::vector<PoseFile>& files, const ColumnMap& columns,
                        const AssumedUnits& units, const Chain& chain, std::vector<std::string>& sentences) {
  const YamlNode* node = root.find("join");
  if (files.size() == 1) {
    if (node) node->fail("", "joins the rows of several files, and `poses` names one");
    std::optional<double> origin_s;
    if (columns.time) times_as_seconds(files[0].table, *columns.time, origin_s, sentences);
    return alone(files[0].table);
  }
  if (!node) {
    root.at("poses").fail(
        "", "names several files: `join` must say how their rows belong together, such as join: {by: name}");
  }
  const JoinRule rule = read_rule(*node);
  const std::size_t lead = leading_file(columns);
  JoinedRows rows;
  std::vector<std::string> warnings;
  if (columns.time && rule.by != JoinBy::time) {
    std::optional<double> origin_s;
    times_as_seconds(files[columns.time->table].table, *columns.time, origin_s, warnings);
  }
  switch (rule.by) {
    case JoinBy::name:
      rows = join_by_name(tables_of(files), pose_names(files, node->at("by")), lead, rule.unmatched);
      break;
    case JoinBy::order:
      rows = join_by_order(tables_of(files), lead);
      break;
    case JoinBy::time:
      rows = TimeJoin(*node, files, columns, units, chain).run(rule, warnings);
      break;
  }
  std::string names;
  for (const PoseFile& file : files) names += (names.empty() ? "" : ", ") + file.table.file;
  sentences.push_back(names + ": " + rows.sentence);
  sentences.insert(sentences.end(), warnings.begin(), warnings.end());
  return {tables_of(files), std::move(rows.rows), columns.joints.front().table};
}

}  // namespace demecal::inline data_files
