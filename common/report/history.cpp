#include "report/history.hpp"

#include <fmt/format.h>

#include <sstream>

#include "data/csv.hpp"
#include "expression/text.hpp"

namespace demecal {
namespace {

/// A worker's name comes over the network: it may hold anything, but a row is one line.
std::string on_one_line(std::string name) {
  for (char& letter : name) {
    if (letter == '\n' || letter == '\r') letter = ' ';
  }
  return name;
}

CsvRow written(const HistoryRow& row) {
  return {0,
          {std::to_string(row.island.joint + 1), std::to_string(row.island.deme + 1), std::to_string(row.generation),
           fmt::format("{}", row.figures.best), fmt::format("{}", row.figures.median),
           std::to_string(row.figures.best_length), std::to_string(row.evaluations), std::to_string(row.migrants_taken),
           on_one_line(row.worker)}};
}

std::string text_of(const CsvTable& table) {
  std::ostringstream text;
  write_csv(text, table);
  return text.str();
}

}  // namespace

std::string history_csv(const std::vector<HistoryRow>& rows) {
  CsvTable table{.file = {}, .header_line = 0, .columns = {}, .rows = {}};
  table.columns = {"joint",       "island",      "generation",     "best_fitness", "median_fitness",
                   "best_length", "evaluations", "migrants_taken", "worker"};
  for (const HistoryRow& row : rows) table.rows.push_back(written(row));
  return text_of(table);
}

std::string distal_csv(const std::vector<DistalStep>& steps) {
  CsvTable table{.file = {}, .header_line = 0, .columns = {}, .rows = {}};
  table.columns = {"joint", "generation", "expression", "index_mm2"};
  for (const DistalStep& step : steps) {
    table.rows.push_back({0,
                          {std::to_string(step.joint + 1), std::to_string(step.generation),
                           to_text(step.correction.formula()), fmt::format("{}", step.index_mm2)}});
  }
  return text_of(table);
}

}  // namespace demecal
