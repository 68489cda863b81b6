#include "drafting/assumptions.hpp"

#include <algorithm>
#include <filesystem>
#include <optional>
#include <ranges>

#include "data/columns.hpp"
#include "tables/guess_columns.hpp"
#include "tables/read_table.hpp"

namespace demecal::inline drafting {

std::string in_words(const CsvTable& table, const std::vector<std::size_t>& columns) {
  std::string words;
  for (const std::size_t column : columns)
    words += (words.empty() ? "" : ", ") + (table.header_line > 0 ? table.columns[column] : std::to_string(column + 1));
  return words;
}

void add_assumed_circumstances(const GivenTable& given, std::vector<std::string>& assumed) {
  const CsvTable& table = given.read.table;
  const auto add = [&](const std::optional<std::size_t>& column, Quantity quantity, const std::string& sentence) {
    if (column && !states_unit(table, *column, quantity))
      assumed.push_back(in_words(table, {*column}) + " of " + given.path.string() + " is taken to be " + sentence);
  };
  add(given.columns.temperature, Quantity::temperature,
      "the arm's temperature in deg C, since its heading states no unit: end the name in _f or _k if it is in deg F or "
      "K");
  add(given.columns.payload, Quantity::mass,
      "the payload in kg, since its heading states no unit: end the name in _g if it is in g");
}

void add_unused(const GivenTable& given, std::vector<std::string>& assumed) {
  constexpr std::size_t kMostNamed = 12;
  const std::vector<std::size_t> used = given.columns.all();
  std::vector<std::size_t> unused;
  for (std::size_t column = 0; column < given.read.table.columns.size(); ++column)
    if (std::ranges::find(used, column) == used.end()) unused.push_back(column);
  if (unused.empty()) return;
  const std::size_t more = unused.size() - std::min(unused.size(), kMostNamed);
  unused.resize(unused.size() - more);
  assumed.push_back("not used: columns " + in_words(given.read.table, unused) +
                    (more > 0 ? " and " + std::to_string(more) + " more" : "") + " of " + given.path.string());
}

}  // namespace demecal::inline drafting
