#include "report/check_history.hpp"

#include <algorithm>
#include <sstream>

#include "data/columns.hpp"
#include "data/csv.hpp"
#include "data/text.hpp"
#include "effects/effect.hpp"
#include "kinematics/units.hpp"
#include "next_measurement/next_measurement.hpp"
#include "report/history.hpp"

namespace demecal::inline report {
namespace {

const std::vector<std::string>& columns() {
  static const std::vector<std::string> all{"date",  "verdict", "strain", "strain_limit", "error_mm",
                                            "poses", "cause",   "data",   "model"};
  return all;
}

}  // namespace

CheckRecord check_record(const ChangeReport& change, const DataSet& data, const std::string& model_file,
                         const std::string& date) {
  std::string causes;
  for (const ChangeCause& cause : change.found) causes += (causes.empty() ? "" : " and ") + to_string(cause.effect);
  if (change.unnamed) causes = "cannot be named";
  return {.date = date,
          .model = model_file,
          .data = data.name,
          .poses = change.poses,
          .verdict = std::string(to_string(change.verdict)),
          .strain = change.strain,
          .strain_limit = change.strain_limit,
          .error_mm = millimetres(change.error_m),
          .cause = causes};
}

std::string check_history_csv(const std::vector<CheckRecord>& records) {
  CsvTable table;
  table.columns = columns();
  for (const CheckRecord& one : records)
    table.rows.push_back({0,
                          {on_one_line(one.date), one.verdict, number_text(one.strain), number_text(one.strain_limit),
                           number_text(one.error_mm), std::to_string(one.poses), on_one_line(one.cause),
                           on_one_line(one.data), on_one_line(one.model)}});
  std::ostringstream text;
  write_csv(text, table);
  return text.str();
}

std::vector<CheckRecord> read_check_history(const std::string& text, const std::string& file) {
  std::vector<CheckRecord> records;
  if (text.empty()) return records;
  std::istringstream in(text);
  const CsvTable table = read_csv(in, file);
  std::vector<TableColumn> read;
  for (const std::string& column : columns()) read.emplace_back(table, ColumnName{column, {file, table.header_line}});
  for (const CsvRow& row : table.rows)
    records.push_back({.date = read[0].text(row),
                       .model = read[8].text(row),
                       .data = read[7].text(row),
                       .poses = static_cast<std::uint64_t>(std::max(0.0, read[5].number(row))),
                       .verdict = read[1].text(row),
                       .strain = read[2].number(row),
                       .strain_limit = read[3].number(row),
                       .error_mm = read[4].number(row),
                       .cause = read[6].text(row)});
  return records;
}

}  // namespace demecal::inline report
