#include "drafting/draft_data_set.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <optional>
#include <set>
#include <sstream>
#include <string>
#include <string_view>
#include <system_error>
#include <utility>

#include "data/columns.hpp"
#include "data/csv.hpp"
#include "data/read_poses.hpp"
#include "data/text.hpp"
#include "drafting/assumptions.hpp"
#include "errors/input_error.hpp"
#include "tables/join.hpp"
#include "tables/time_stamp.hpp"
#include "yaml/files.hpp"
#include "yaml/yaml_text.hpp"

namespace demecal::inline drafting {
namespace {

/// A column as data sets refer to it: by its name where that is a name, else by its number.
std::string reference(const CsvTable& table, std::size_t column) {
  const std::string& name = table.columns[column];
  const bool named =
      table.header_line > 0 && std::ranges::count(table.columns, name) == 1 && name != std::to_string(column + 1);
  return named ? yaml_text(name) : std::to_string(column + 1);
}

std::string references(const CsvTable& table, const std::vector<std::size_t>& columns) {
  std::vector<std::string> names;
  for (const std::size_t column : columns) names.push_back(reference(table, column));
  return yaml_list(names);
}

double largest_number(const CsvTable& table, const std::vector<std::size_t>& columns) {
  double most = 0.0;
  for (const std::size_t index : columns) {
    const TableColumn column(table, {table.columns[index], {}, index + 1});
    for (const CsvRow& row : table.rows) most = std::max(most, std::abs(column.number(row)));
  }
  return most;
}

/// The unit of columns that state none, by how large their values are.
struct AssumedUnit {
  std::string key, unit, sentence;
};
std::optional<AssumedUnit> assumed_unit(const GivenTable& given, const std::string& key, Quantity quantity,
                                        const std::vector<std::size_t>& columns) {
  const CsvTable& table = given.read.table;
  if (std::ranges::all_of(columns, [&](std::size_t column) { return states_unit(table, column, quantity); })) return {};
  const double most = largest_number(table, columns);
  const std::string unit(likely_unit(quantity, most));
  return AssumedUnit{key, unit,
                     "units of " + in_words(table, columns) + " are taken to be " + unit + ", since the largest is " +
                         number_text(std::round(1e3 * most) / 1e3) + ": check `units`"};
}

/// The units of angles and of lengths that no heading states. Throws InputError where those of rails and of positions
/// seem to differ, as no data set can say.
std::vector<AssumedUnit> assumed_units(const std::vector<GivenTable>& tables, std::size_t rails) {
  std::optional<AssumedUnit> angle, length, rail;
  for (const GivenTable& given : tables) {
    const std::vector<std::size_t>& joints = given.columns.joints;
    const auto carried = joints.begin() + static_cast<std::ptrdiff_t>(std::min(rails, joints.size()));
    if (!angle) angle = assumed_unit(given, "angle", Quantity::angle, {carried, joints.end()});
    if (!rail) rail = assumed_unit(given, "length", Quantity::length, {joints.begin(), carried});
    if (!length) length = assumed_unit(given, "length", Quantity::length, given.columns.position);
    if (rail && length && rail->unit != length->unit)
      throw InputError({given.path.string(), given.read.table.header_line}, "",
                       "states no units, and seems to have several: " + rail->sentence + ", and " + length->sentence +
                           ". Write the unit of the rail into its heading, as in `E1 [" + rail->unit + "]`");
  }
  std::vector<AssumedUnit> assumed;
  for (const auto& one : {angle, rail && !length ? rail : length})
    if (one) assumed.push_back(*one);
  if (rail && length) assumed.back().sentence += "; " + rail->sentence;
  return assumed;
}

/// Columns that are called as uncertainties of the position may be, and can be that.
bool are_sigmas(const CsvTable& table, const std::vector<std::size_t>& columns) {
  return std::ranges::all_of(columns, [&](std::size_t index) {
    const TableColumn column(table, {table.columns[index], {}, index + 1});
    return std::ranges::all_of(
        table.rows, [&](const CsvRow& row) { return is_numeric(column.text(row)) && column.number(row) > 0.0; });
  });
}

bool holds_several(const CsvTable& table, std::size_t column) {
  return std::ranges::any_of(
      table.rows, [&](const CsvRow& row) { return row.fields[column] != table.rows.front().fields[column]; });
}

/// The last part of the folder's path, "." and ".." resolved.
std::string folder_name(const std::filesystem::path& folder) {
  const std::filesystem::path whole = std::filesystem::weakly_canonical(std::filesystem::absolute(folder));
  const std::filesystem::path name = whole.has_filename() ? whole.filename() : whole.parent_path().filename();
  return name.empty() ? "measurement" : name.string();
}

/// Targets are left out: where several are on the tool, their places are needed too.
std::string columns_text(const GivenTable& given, const std::string& indent) {
  const CsvTable& table = given.read.table;
  std::ostringstream text;
  GuessedColumns::for_each_key([&](std::string_view key, auto member) {
    const auto& columns = given.columns.*member;
    if (key == "target" || columns_in(columns).empty()) return;
    text << indent << key << ": ";
    if constexpr (requires { columns.size(); }) {
      text << references(table, columns) << '\n';
    } else {
      text << reference(table, *columns) << '\n';
    }
  });
  return text.str();
}

std::string layout_text(const ToldLayout& told, const std::string& indent) {
  std::string text;
  if (told.delimiter) text += indent + "delimiter: " + std::string(to_string(*told.delimiter)) + "\n";
  if (told.decimal) text += indent + "decimal: " + (*told.decimal == ',' ? "comma" : "point") + "\n";
  if (told.header_line) text += indent + "header_line: " + std::to_string(*told.header_line) + "\n";
  return text;
}

std::string relative_name(const std::filesystem::path& path, const std::filesystem::path& folder) {
  std::error_code fault;
  const std::filesystem::path relative =
      std::filesystem::relative(std::filesystem::absolute(path), std::filesystem::absolute(folder), fault);
  return fault || relative.empty() ? std::filesystem::absolute(path).string() : relative.generic_string();
}

/// A way in which the rows of several tables may belong together.
struct JoinDraft {
  std::string yaml, sentence;
};

double median_step_s(const CsvTable& table, std::size_t column) {
  CsvTable copy = table;
  std::optional<double> origin_s;
  write_times_as_seconds(copy, column, origin_s);
  const TableColumn times(copy, {copy.columns[column], {}, column + 1}, Quantity::time, {});
  std::vector<double> steps;
  for (std::size_t row = 1; row < copy.rows.size(); ++row)
    steps.push_back(std::abs(times.number(copy.rows[row]) - times.number(copy.rows[row - 1])));
  if (steps.empty()) return 0.0;
  std::ranges::nth_element(steps, steps.begin() + static_cast<std::ptrdiff_t>(steps.size() / 2));
  return steps[steps.size() / 2];
}

std::vector<JoinDraft> possible_joins(const std::vector<GivenTable>& tables) {
  if (tables.size() == 1) return {{"", ""}};
  const auto all_have = [&](auto member) {
    return std::ranges::all_of(tables, [&](const GivenTable& given) { return (given.columns.*member).has_value(); });
  };
  std::vector<JoinDraft> joins;
  if (all_have(&GuessedColumns::pose))
    joins.push_back({"join: {by: name}\n", "rows of the files are joined by the name of the point"});
  // Where most names are the same, the others are mistakes, which no other way to join may hide.
  if (most_names_agree(tables)) return joins;
  if (all_have(&GuessedColumns::time)) {
    double step_s = 1e9;
    for (const GivenTable& given : tables)
      step_s = std::min(step_s, median_step_s(given.read.table, *given.columns.time));
    // A logger's rows are closer than an instrument's: half a step of it, and what clocks are rounded by.
    const std::string within = number_text(std::clamp(std::round(1e3 * 0.6 * step_s) / 1e3, 0.01, 0.5));
    for (const char* offset : {"0", "auto"}) {
      joins.push_back({"join: {by: time, within_s: " + within + ", offset_s: " + offset + "}\n",
                       "rows of the files are joined by time, within " + within +
                           (offset == std::string("0") ? " s, as if both clocks agreed"
                                                       : " s; the offset of the clocks is found by the arm's motion")});
    }
  }
  joins.push_back({"join: {by: order}\n",
                   "rows of the files are joined by their order, since they have neither names nor times that match: "
                   "check that none is missing"});
  return joins;
}

/// Tables that give a quantity; where several do, the first counts, of what is measured the first without joints: a
/// controller's own table has positions that it computed from them.
void keep_one_source(std::vector<GivenTable>& tables, std::vector<std::size_t> GuessedColumns::*group,
                     std::vector<std::string>& assumed, const char* what) {
  const auto gives = [&](const GivenTable& given) { return !(given.columns.*group).empty(); };
  auto source = std::ranges::find_if(tables, gives);
  if (group != &GuessedColumns::joints) {
    const auto beside = std::ranges::find_if(
        tables, [&](const GivenTable& given) { return gives(given) && given.columns.joints.empty(); });
    if (beside != tables.end()) source = beside;
  }
  for (GivenTable& given : tables) {
    if (!gives(given) || &given == &*source) continue;
    (given.columns.*group).clear();
    assumed.push_back(std::string(what) + " are those of " + source->path.string() + ", not of " + given.path.string());
  }
}

void require_columns(const std::vector<GivenTable>& tables, bool found, const std::string& what) {
  if (found) return;
  std::string names;
  for (const GivenTable& given : tables) names += (names.empty() ? "" : ", ") + given.path.string();
  throw InputError({names, 0}, "", what);
}

}  // namespace

std::vector<DataSetDraft> draft_data_sets(const std::vector<GivenTable>& given_tables,
                                          const std::filesystem::path& folder, const std::string& robot,
                                          std::size_t joints, const ToldLayout& told, std::size_t rails) {
  std::vector<GivenTable> tables = given_tables;
  std::vector<std::string> assumed;
  keep_one_source(tables, &GuessedColumns::joints, assumed, "joints");
  keep_one_source(tables, &GuessedColumns::position, assumed, "positions");
  keep_one_source(tables, &GuessedColumns::orientation, assumed, "orientations");
  for (GivenTable& given : tables) {
    std::vector<std::size_t>& sigma = given.columns.sigma;
    if (given.columns.position.empty() || !are_sigmas(given.read.table, sigma)) sigma.clear();
    if (!sigma.empty())
      assumed.push_back("positions weigh by " + in_words(given.read.table, sigma) +
                        ", taken to be their standard uncertainties: leave `sigma` out if they are not");
  }
  for (const GivenTable& given : tables) {
    if (!given.columns.target || !holds_several(given.read.table, *given.columns.target)) continue;
    assumed.push_back("all points are taken to be of one target: if " +
                      in_words(given.read.table, {*given.columns.target}) + " of " + given.path.string() +
                      " names several on the tool, name it under `columns: target` and give their places under "
                      "`tools_mm`");
  }
  const auto any = [&](auto group) {
    return std::ranges::any_of(tables, [&](const GivenTable& given) { return !(given.columns.*group).empty(); });
  };
  require_columns(
      tables, any(&GuessedColumns::joints),
      "no columns are called as the " + std::to_string(joints) +
          " joints may be (q1 ..., j1 ..., joint_1 ..., A1 ...): rename them, or name them in a data set by hand "
          "(`demecal template dataset`)");
  const bool touched =
      std::ranges::any_of(tables, [](const GivenTable& given) { return given.columns.contact.has_value(); });
  require_columns(
      tables, any(&GuessedColumns::position) || any(&GuessedColumns::orientation) || touched,
      "no columns are called as measured points may be (x, y, z; X [mm] ...), nor any as what the tool touches "
      "(contact): rename them, or name them in a data set by hand (`demecal template dataset`)");
  std::string body =
      "demecal_dataset: 1\nname: " + yaml_text(folder_name(folder)) + "\nrobot: " + yaml_text(robot) + "\n";
  if (tables.size() == 1 && layout_text(told, "").empty()) {
    body += "poses: " + yaml_text(relative_name(tables[0].path, folder)) +
            "\ncolumns:                 # by name, or by number from 1\n" + columns_text(tables[0], "  ");
  } else {
    body += "poses:                   # several files, each with its columns: by name, or by number from 1\n";
    for (const GivenTable& given : tables) {
      body += "  - file: " + yaml_text(relative_name(given.path, folder)) + "\n" + layout_text(told, "    ") +
              "    columns:\n" + columns_text(given, "      ");
    }
  }
  const std::vector<AssumedUnit> units = assumed_units(tables, rails);
  if (!units.empty()) body += "units:                   # of columns whose headings state none\n";
  for (const AssumedUnit& unit : units) {
    body += "  " + unit.key + ": " + unit.unit + "\n";
    assumed.push_back(unit.sentence);
  }
  for (const GivenTable& given : tables) {
    add_assumed_circumstances(given, assumed);
    add_unused(given, assumed);
  }
  if (any(&GuessedColumns::position))
    assumed.push_back("positions are in the instrument's own frame: set `frame: base` if they are in the robot's");
  if (touched)
    assumed.push_back(
        "equal words under contact are one point each that the tool touches; say under `contacts` what else is known "
        "of them");
  std::vector<DataSetDraft> drafts;
  for (const JoinDraft& join : possible_joins(tables)) {
    DataSetDraft draft{body + join.yaml, assumed};
    if (!join.sentence.empty()) draft.assumed.push_back(join.sentence);
    draft.text += "frame: sensor            # base: positions are in the robot's frame\n";
    const bool sets =
        std::ranges::any_of(tables, [](const GivenTable& given) { return given.columns.set.has_value(); });
    if (!sets)
      draft.text +=
          "split: {validation_fraction: 0.3, seed: 1}   # these poses choose between models, the others are fitted\n";
    drafts.push_back(std::move(draft));
  }
  return drafts;
}

}  // namespace demecal::inline drafting
