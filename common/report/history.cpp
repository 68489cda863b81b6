#include "report/history.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <functional>
#include <iterator>
#include <limits>
#include <optional>
#include <sstream>
#include <string>
#include <vector>

#include "data/csv.hpp"
#include "data/text.hpp"
#include "errors/input_error.hpp"
#include "expression/text.hpp"
#include "expression/tree.hpp"
#include "prediction/corrected_robot.hpp"
#include "report/pose_places.hpp"

namespace demecal::inline report {
namespace {

CsvRow as_csv_row(const HistoryRow& row) {
  return {0,
          {std::to_string(row.island.joint + 1), std::to_string(row.island.deme + 1), std::to_string(row.generation),
           fmt::format("{}", row.figures.best), fmt::format("{}", row.figures.median),
           std::to_string(row.figures.best_length), std::to_string(row.evaluations), std::to_string(row.migrants_taken),
           on_one_line(row.worker)}};
}

constexpr double kNotANumber = std::numeric_limits<double>::quiet_NaN();
const std::string kHistoryFile = "history.csv";

bool has_rows(const std::string& csv) {
  std::istringstream lines(csv);
  int written = 0;
  for (std::string line; std::getline(lines, line);) {
    const std::size_t first = line.find_first_not_of(" \t\r");
    if (first != std::string::npos && line[first] != '#') ++written;
  }
  return written > 1;
}

std::size_t column(const CsvTable& table, const std::string& name) {
  const std::optional<std::size_t> found = table.find(name);
  if (!found) throw InputError({kHistoryFile, table.header_line}, "", "has no column " + name);
  return *found;
}

std::uint64_t number_from_one(const CsvRow& row, std::size_t at) {
  const std::optional<double> value = parse_number(row.fields[at]);
  const bool counts = value && *value >= 1.0 && *value <= 1e6 && *value == std::floor(*value);
  if (!counts) throw InputError({kHistoryFile, row.line}, row.fields[at], "must be a whole number from 1");
  return static_cast<std::uint64_t>(*value);
}

double number_field(const CsvRow& row, std::size_t at) {
  const std::optional<double> value = parse_number(row.fields[at]);
  if (!value) throw InputError({kHistoryFile, row.line}, row.fields[at], "must be a number");
  return *value;
}

/// Nothing where the fitness is written, but is not finite.
std::optional<double> fitness_field(const CsvRow& row, std::size_t at) {
  for (const char* const word : {"inf", "-inf", "nan", "-nan"}) {
    if (row.fields[at] == word) return std::nullopt;
  }
  return number_field(row, at);
}

void find_extent(FitnessHistory& history) {
  std::vector<double> positive;
  for (const auto& [joint, curves] : history.joints) {
    for (const auto& [island, points] : curves) {
      for (const FitnessPoint& point : points) {
        if (point.best > 0.0) positive.push_back(point.best);
      }
    }
  }
  if (positive.empty()) positive = {1.0};
  const auto [lowest, highest] = std::ranges::minmax(positive);
  history.lowest = lowest;
  history.highest = highest;
}

}  // namespace

std::string on_one_line(std::string name) {
  for (char& letter : name) {
    if (letter == '\n' || letter == '\r') letter = ' ';
  }
  return name;
}

std::string history_csv(const std::vector<HistoryRow>& rows) {
  CsvTable table{.file = {}, .header_line = 0, .columns = {}, .rows = {}};
  table.columns = {"joint",       "island",      "generation",     "best_fitness", "median_fitness",
                   "best_length", "evaluations", "migrants_taken", "worker"};
  for (const HistoryRow& row : rows) table.rows.push_back(as_csv_row(row));
  return csv_text(table);
}

std::string distal_csv(const std::vector<DistalEntry>& steps) {
  CsvTable table{.file = {}, .header_line = 0, .columns = {}, .rows = {}};
  table.columns = {"joint", "generation", "expression", "index_mm2"};
  for (const DistalEntry& step : steps) {
    table.rows.push_back({0,
                          {std::to_string(step.joint), std::to_string(step.generation), step.expression,
                           fmt::format("{}", step.index_mm2.value_or(kNotANumber))}});
  }
  return csv_text(table);
}

std::string fronts_csv(const std::vector<EvolvedCorrection>& fronts) {
  CsvTable table{.file = {}, .header_line = 0, .columns = {}, .rows = {}};
  table.columns = {"joint", "nodes", "mean_abs_error_rad", "bound_rad", "jumps", "expression"};
  for (const EvolvedCorrection& one : fronts) {
    const Tree& formula = one.correction.formula();
    table.rows.push_back(
        {0,
         {std::to_string(one.joint + 1), std::to_string(formula.size()), fmt::format("{}", one.mean_abs_error_rad),
          fmt::format("{}", one.bound_rad), std::to_string(one.jumps), to_string(formula)}});
  }
  return csv_text(table);
}

FitnessHistory fitness_of(const std::vector<HistoryRow>& rows) {
  FitnessHistory history;
  for (const HistoryRow& row : rows) {
    std::vector<FitnessPoint>& points = history.joints[row.island.joint + 1][row.island.deme + 1];
    if (std::isfinite(row.figures.best)) points.push_back({static_cast<double>(row.generation), row.figures.best});
  }
  find_extent(history);
  return history;
}

FitnessHistory read_fitness(const std::string& csv) {
  FitnessHistory history;
  if (has_rows(csv)) {
    std::istringstream text(csv);
    const CsvTable table = read_csv(text, kHistoryFile);
    const std::size_t joint = column(table, "joint"), island = column(table, "island");
    const std::size_t generation = column(table, "generation"), best = column(table, "best_fitness");
    for (const CsvRow& row : table.rows) {
      std::vector<FitnessPoint>& points = history.joints[number_from_one(row, joint)][number_from_one(row, island)];
      if (const auto fitness = fitness_field(row, best)) points.push_back({number_field(row, generation), *fitness});
    }
  }
  find_extent(history);
  return history;
}

namespace {

using Vectors = std::vector<double> PosePlace::*;

std::string cell(const std::optional<double>& value) {
  return value ? number_text(*value) : std::string();
}

/// As many cells as `count`, empty where there are fewer numbers.
void add_cells(const std::vector<double>& values, std::size_t count, CsvRow& row) {
  for (std::size_t i = 0; i < count; ++i)
    row.fields.push_back(i < values.size() ? number_text(values[i]) : std::string());
}

struct VectorColumns {
  Vectors values;
  const char* names[3];
};
constexpr VectorColumns kVectors[] = {{&PosePlace::position_mm, {"x_mm", "y_mm", "z_mm"}},
                                      {&PosePlace::before_error_mm, {"before_x_mm", "before_y_mm", "before_z_mm"}},
                                      {&PosePlace::after_error_mm, {"after_x_mm", "after_y_mm", "after_z_mm"}}};

}  // namespace

std::string pose_errors_csv(const Report& report) {
  const std::vector<PoseErrorEntry>& poses = report.pose_errors;
  const auto any = [&poses](const auto& has) { return std::ranges::any_of(poses, has); };
  std::size_t joints = 0;
  for (const PoseErrorEntry& pose : poses) joints = std::max(joints, pose.place.joints.size());
  CsvTable table;
  table.columns = {"id", "target", "set", "before_mm", "after_mm", "interval95_mm", "flags"};
  for (std::size_t joint = 0; joint < joints; ++joint) {
    const bool slides =
        report.arm && joint < report.arm->joints.size() && report.arm->joints[joint].type == "prismatic";
    table.columns.push_back("q" + std::to_string(joint + 1) + (slides ? "_mm" : "_deg"));
  }
  std::vector<VectorColumns> vectors;
  for (const VectorColumns& columns : kVectors) {
    if (!any([&](const PoseErrorEntry& pose) { return !(pose.place.*columns.values).empty(); })) continue;
    vectors.push_back(columns);
    table.columns.insert(table.columns.end(), std::begin(columns.names), std::end(columns.names));
  }
  const bool warm = any([](const PoseErrorEntry& pose) { return pose.place.temperature_celsius.has_value(); });
  const bool timed = any([](const PoseErrorEntry& pose) { return pose.place.time_s.has_value(); });
  if (warm) table.columns.emplace_back("temperature_celsius");
  if (timed) table.columns.emplace_back("time_s");
  for (const PoseErrorEntry& pose : poses) {
    CsvRow& row = table.rows.emplace_back();
    row.fields = {on_one_line(pose.id),         on_one_line(pose.target), pose.set,
                  cell(pose.before_mm),         cell(pose.after_mm),      cell(pose.interval95_mm),
                  joined_words(pose.flags, " ")};
    add_cells(pose.place.joints, joints, row);
    for (const VectorColumns& columns : vectors) add_cells(pose.place.*columns.values, 3, row);
    if (warm) row.fields.push_back(cell(pose.place.temperature_celsius));
    if (timed) row.fields.push_back(cell(pose.place.time_s));
  }
  return csv_text(table);
}

}  // namespace demecal::inline report
