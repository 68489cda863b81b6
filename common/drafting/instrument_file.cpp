#include "drafting/instrument_file.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "data/columns.hpp"
#include "data/csv.hpp"
#include "data/text.hpp"
#include "tables/guess_columns.hpp"
#include "tables/read_table.hpp"
#include "yaml/files.hpp"

namespace demecal::inline drafting {
namespace {

/// What tells points in a table of another program, by its headings; where these state no unit, by how large they are.
PointColumns guessed_points(const CsvTable& table, std::vector<std::string>& assumed) {
  PointColumns points;
  const GuessedColumns guess = guess_columns(table, 0, {});
  const auto column = [&](std::size_t index) {
    return ColumnName{table.columns[index], {table.file, table.header_line}, index + 1};
  };
  if (guess.pose) points.pose = column(*guess.pose);
  double most = 0.0;
  bool stated = true;
  for (const std::size_t index : guess.position) {
    points.position.push_back(column(index));
    if (states_unit(table, index, Quantity::length)) continue;
    stated = false;
    const TableColumn numbers(table, points.position.back());
    for (const CsvRow& row : table.rows) most = std::max(most, std::abs(numbers.number(row)));
  }
  if (stated) return points;
  const std::string unit(likely_unit(Quantity::length, most));
  points.units.length = find_unit(unit);
  assumed.push_back(table.file + ": points are taken to be in " + unit + ", since the largest number is " +
                    number_text(std::round(1e3 * most) / 1e3) +
                    "; if not, name the unit in the headings (x_mm or x_m)");
  return points;
}

}  // namespace

Readings read_instrument_file(const std::filesystem::path& path, const std::optional<CordInstrument>& cords,
                              std::vector<std::string>& assumed) {
  const std::string file = path.string();
  const RecognisedTable read = read_table(with_marked_names(decode_text(read_file(path), file).text, file), file);
  if (!read.found.empty()) assumed.push_back(file + ": " + read.found);
  const bool ours = has_columns_of_readings(read.table);
  return read_readings(read.table, cords, ours ? PointColumns{} : guessed_points(read.table, assumed));
}

}  // namespace demecal::inline drafting
