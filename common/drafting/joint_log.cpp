#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <filesystem>
#include <iterator>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "data/columns.hpp"
#include "data/csv.hpp"
#include "data/data_set.hpp"
#include "data/read_poses.hpp"
#include "data/text.hpp"
#include "data_files/data_set_file.hpp"
#include "data_files/pose_files.hpp"
#include "drafting/draft_data_set.hpp"
#include "drafting/preparation_file.hpp"
#include "errors/input_error.hpp"
#include "kinematics/chain.hpp"
#include "preparation/joint_log.hpp"
#include "tables/guess_columns.hpp"
#include "tables/layout.hpp"
#include "tables/read_table.hpp"
#include "tables/time_stamp.hpp"
#include "yaml/files.hpp"
#include "yaml/yaml_node.hpp"

namespace demecal::inline drafting {
namespace {

const YamlNode* child_of(const LogRequest& request, std::string_view key) {
  return request.node ? request.node->find(key) : nullptr;
}

class LogReader {
 public:
  LogReader(const LogRequest& request, const Robot& robot, std::optional<double>& origin_s,
            std::vector<std::string>& assumed)
      : request_(request), robot_(robot), origin_s_(origin_s), assumed_(assumed) {}

  JointLog read() {
    const ToldLayout told = request_.node ? read_layout(*request_.node) : ToldLayout{};
    RecognisedTable recognised = read_table(read_file(request_.path), request_.path.string(), told);
    table_ = std::move(recognised.table);
    if (!recognised.found.empty()) assume(recognised.found);
    find_columns();
    find_units();
    JointLog log;
    log.file = request_.path.string();
    if (const YamlNode* set = child_of(request_, "set"))
      log.set = set->one_of<PoseSet>(
          {{"calibration", PoseSet::calibration}, {"validation", PoseSet::validation}, {"accept", PoseSet::accept}});
    read_rows(log);
    return log;
  }

 private:
  void assume(const std::string& sentence) { assumed_.push_back(request_.path.string() + ": " + sentence); }

  ColumnName guessed(std::size_t column) const {
    return {table_.columns[column], {request_.path.string(), table_.header_line}, column + 1};
  }

  void find_columns() {
    const YamlNode* told = child_of(request_, "columns");
    if (told) {
      told->with_keys({"joints", "time", "nanoseconds"});
      if (const YamlNode* joints = told->find("joints"))
        for (const YamlNode& joint : joints->list()) joints_.push_back(read_column(joint));
      if (const YamlNode* time = told->find("time")) times_.push_back(read_column(*time));
      const YamlNode* nanoseconds = told->find("nanoseconds");
      if (nanoseconds && times_.empty())
        nanoseconds->fail("counts from whole seconds: name their column too, as columns.time");
      if (nanoseconds) times_.push_back(read_column(*nanoseconds));
    }
    const GuessedColumns guess =
        guess_columns(table_, robot_.chain.joints.size(), joint_names(robot_), leading_rails(robot_.chain));
    if (joints_.empty()) {
      for (const std::size_t column : guess.joints) joints_.push_back(guessed(column));
      require_no_more(count_joint_columns(table_));
    }
    if (times_.empty() && guess.time) times_.push_back(guessed(*guess.time));
    const InputError::Where where{request_.path.string(), table_.header_line};
    if (joints_.size() != robot_.chain.joints.size())
      throw InputError(where, "",
                       "needs a column for each of the " + std::to_string(robot_.chain.size()) +
                           " joints, called q1 ..., joint_1 ..., or as the robot file calls them; name others with "
                           "columns: {joints: [...], time: ...} beside `file` under log.files");
    if (times_.empty())
      throw InputError(where, "",
                       "needs a column of times, called time, timestamp or stamp; name another with columns: "
                       "{joints: [...], time: ...} beside `file` under log.files");
  }

  void require_no_more(std::size_t joints) const {
    if (joints_.empty() || joints <= joints_.size()) return;
    throw InputError({request_.path.string(), table_.header_line}, "",
                     "has columns of " + std::to_string(joints) + " joints, and the robot has " +
                         std::to_string(joints_.size()) +
                         ": is it of this arm? Where further axes are recorded, name those of the arm with columns: "
                         "{joints: [...]} beside `file` under log.files");
  }

  /// What the headings do not say is taken from how large the numbers are.
  void find_units() {
    if (const YamlNode* told = child_of(request_, "units")) units_ = read_units(told);
    for (const bool angles : {true, false}) {
      std::optional<ColumnUnit>& unit = angles ? units_.angle : units_.length;
      double most = 0.0;
      bool any = false;
      for (std::size_t joint = 0; joint < joints_.size(); ++joint) {
        if (is_revolute(robot_.chain.joints[joint]) != angles) continue;
        const TableColumn column(table_, joints_[joint]);
        if (states_unit(table_, column.index(), angles ? Quantity::angle : Quantity::length)) continue;
        for (const CsvRow& row : table_.rows) most = std::max(most, std::abs(column.number(row)));
        any = true;
      }
      if (!any || unit) continue;
      const std::string name(likely_unit(angles ? Quantity::angle : Quantity::length, most));
      unit = find_unit(name);
      assume("joints are taken to be in " + name + ", since the largest number is " +
             number_text(std::round(1e3 * most) / 1e3) + "; if not, set `units`");
    }
  }

  std::vector<double> read_times() {
    std::optional<double> since_1970_s = 0.0;
    const TimeColumn kind = write_times_as_seconds(table_, TableColumn(table_, times_.front()).index(), since_1970_s);
    if (!kind.remark.empty()) assume(kind.remark);
    const TableColumn column(table_, times_.front(), Quantity::time, units_);
    std::vector<double> times_s;
    for (const CsvRow& row : table_.rows) times_s.push_back(column.number(row));
    if (times_.size() > 1) {
      const TableColumn parts(table_, times_.back());
      for (std::size_t row = 0; row < times_s.size(); ++row) times_s[row] += 1e-9 * parts.number(table_.rows[row]);
    }
    scale_epoch(times_s);
    return times_s;
  }

  /// Counts since 1970 are seconds up to 1e10 for centuries: what is larger counts in smaller units.
  void scale_epoch(std::vector<double>& times_s) {
    constexpr std::pair<double, const char*> kUnits[] = {
        {1e17, "nanoseconds"}, {1e14, "microseconds"}, {1e11, "milliseconds"}};
    constexpr double kScales[] = {1e-9, 1e-6, 1e-3};
    for (std::size_t i = 0; i < std::size(kUnits); ++i) {
      if (times_s.front() < kUnits[i].first) continue;
      for (double& time_s : times_s) time_s *= kScales[i];
      assume(std::string("times are taken to be ") + kUnits[i].second + " since 1970");
      return;
    }
  }

  void read_rows(JointLog& log) {
    const std::vector<double> times_s = read_times();
    std::vector<TableColumn> columns;
    for (std::size_t joint = 0; joint < joints_.size(); ++joint)
      columns.emplace_back(table_, joints_[joint], joint_quantity(robot_.chain.joints[joint]), units_);
    if (!origin_s_) origin_s_ = times_s.front();
    std::size_t repeated = 0;
    for (std::size_t row = 0; row < table_.rows.size(); ++row) {
      const CsvRow& fields = table_.rows[row];
      const double time_s = times_s[row] - *origin_s_;
      if (!log.times_s.empty() && time_s < log.times_s.back())
        throw InputError({table_.file, fields.line}, TableColumn(table_, times_.front()).text(fields),
                         "is earlier than the row before: a log is one recording, in the order of its times; make "
                         "several files of several recordings");
      if (!log.times_s.empty() && time_s == log.times_s.back()) {
        ++repeated;
        continue;
      }
      JointVector joints(robot_.chain.size());
      for (std::size_t joint = 0; joint < columns.size(); ++joint)
        joints[static_cast<Eigen::Index>(joint)] = columns[joint].number(fields);
      log.times_s.push_back(time_s);
      log.joints.push_back(std::move(joints));
      log.lines.push_back(fields.line);
    }
    if (2 * repeated > table_.rows.size())
      throw InputError({table_.file, 0}, "",
                       "has the same time in most rows: its times are rounded too coarsely to tell motion from "
                       "standing; where seconds and nanoseconds are in two columns, name both (columns.nanoseconds)");
    if (repeated > 0) assume(std::to_string(repeated) + " rows repeat the time of the row before, and are left out");
    if (log.times_s.size() < 10)
      throw InputError({table_.file, 0}, "", "has too few rows for a log: ten moments at least are expected");
  }

  const LogRequest& request_;
  const Robot& robot_;
  std::optional<double>& origin_s_;
  std::vector<std::string>& assumed_;
  CsvTable table_;
  std::vector<ColumnName> joints_, times_;
  AssumedUnits units_;
};

}  // namespace

JointLog read_joint_log(const LogRequest& request, const Robot& robot, std::optional<double>& origin_s,
                        std::vector<std::string>& assumed) {
  return LogReader(request, robot, origin_s, assumed).read();
}

}  // namespace demecal::inline drafting
