#include "data_files/join_clocks.hpp"

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "data/read_poses.hpp"
#include "errors/input_error.hpp"

namespace demecal::inline data_files {
namespace {

/// Times of all files in seconds of one kind.
class Clocks {
 public:
  Clocks(bool offset_known, std::vector<std::string>& sentences) : offset_known_(offset_known), sentences_(sentences) {}

  JoinKeys read(PoseFile& file, const ColumnName& name, const AssumedUnits& units) {
    const TimeColumn kind = times_as_seconds(file.table, name, origin_s_, sentences_);
    if (first_ && offset_known_ &&
        (kind.stamps != first_->stamps || kind.dated != first_->dated || kind.zoned != first_->zoned)) {
      throw InputError(
          name.where, name.name,
          "holds times of another kind than " + first_file_ +
              ": some have a date or zone, or are numbers. Give `offset_s: auto` under `join`, or export them alike");
    }
    if (!first_) {
      first_ = kind;
      first_file_ = file.table.file;
    }
    const TableColumn column(file.table, name, Quantity::time, units);
    JoinKeys keys;
    for (const CsvRow& row : file.table.rows) keys.times_s.push_back(column.number(row));
    return keys;
  }

  /// Times of day of one clock, which say nothing of the day.
  bool undated() const { return offset_known_ && first_ && first_->stamps && !first_->dated; }

 private:
  bool offset_known_;
  std::vector<std::string>& sentences_;
  std::optional<double> origin_s_;
  std::optional<TimeColumn> first_;
  std::string first_file_;
};

/// Of files whose clocks have no dates, one may begin before a midnight and another behind it.
void take_other_days(const std::vector<PoseFile>& files, std::size_t lead, const JoinRule& rule,
                     std::vector<JoinKeys>& keys, std::vector<std::string>& sentences) {
  for (std::size_t other = 0; other < files.size(); ++other) {
    if (other == lead) continue;
    const WholeDays found = find_whole_days(keys[lead], keys[other], rule.within_s, *rule.offset_s);
    if (found.days == 0) continue;
    for (double& time_s : keys[other].times_s) time_s += kDay_s * found.days;
    sentences.push_back(files[other].table.file + ": without dates its times are taken to be a day " +
                        (found.days > 0 ? "later" : "earlier") + " than they stand beside those of " +
                        files[lead].table.file + ": so " + std::to_string(found.partners) + " of " +
                        std::to_string(keys[lead].times_s.size()) + " rows there have a partner, and " +
                        std::to_string(found.as_given) + " as they stand");
  }
}

}  // namespace

const ColumnName& key_column(const PoseFile& file, const std::optional<ColumnName>& column, const char* key,
                             const YamlNode& by) {
  if (column) return *column;
  throw InputError({by.file, by.line}, by.scalar,
                   std::string("joins rows by a column that ") + file.table.file + " lacks: name it under `columns." +
                       key + "`, of this file where names differ");
}

TimeColumn times_as_seconds(CsvTable& table, const ColumnName& name, std::optional<double>& origin_s,
                            std::vector<std::string>& sentences) {
  TimeColumn kind = write_times_as_seconds(table, TableColumn(table, name).index(), origin_s);
  if (!kind.remark.empty()) sentences.push_back(table.file + ": " + kind.remark);
  return kind;
}

std::vector<JoinKeys> times_of(std::vector<PoseFile>& files, std::size_t lead, const YamlNode& by,
                               const AssumedUnits& units, const JoinRule& rule, std::vector<std::string>& sentences) {
  Clocks clocks(rule.offset_s.has_value(), sentences);
  std::vector<JoinKeys> keys;
  for (PoseFile& file : files) keys.push_back(clocks.read(file, key_column(file, file.time, "time", by), units));
  if (clocks.undated()) take_other_days(files, lead, rule, keys, sentences);
  return keys;
}

}  // namespace demecal::inline data_files
