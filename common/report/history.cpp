#include "report/history.hpp"

#include <fmt/format.h>

#include <sstream>

#include "data/csv.hpp"

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

}  // namespace

std::string history_csv(const std::vector<HistoryRow>& rows) {
  CsvTable table{.file = {}, .header_line = 0, .columns = {}, .rows = {}};
  table.columns = {"joint",       "island",      "generation",     "best_fitness", "median_fitness",
                   "best_length", "evaluations", "migrants_taken", "worker"};
  for (const HistoryRow& row : rows) table.rows.push_back(written(row));
  std::ostringstream text;
  write_csv(text, table);
  return text.str();
}

}  // namespace demecal
