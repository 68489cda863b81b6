// Tables of random numbers, written as other programs would.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <sstream>
#include <string>
#include <vector>

#include "data/text.hpp"
#include "random/random_stream.hpp"
#include "tables/layout.hpp"

namespace demecal {

/// How a program writes its tables.
struct Habit {
  Delimiter delimiter = Delimiter::comma;
  char decimal = '.';
  int preamble = 0;  ///< lines of words before
  bool headings = true;
  bool units = false;     ///< in brackets beside the names
  bool quotes = false;    ///< around every field
  bool returns = false;   ///< CR LF
  bool comments = false;  ///< between rows
};

struct RandomTable {
  std::vector<std::string> names;            ///< of points, one a row
  std::vector<std::vector<double>> numbers;  ///< rows x columns
};

inline RandomTable random_table(RandomStream& random, std::size_t rows, std::size_t columns) {
  RandomTable table;
  for (std::size_t row = 0; row < rows; ++row) {
    table.names.push_back("Point-" + std::to_string(row + 1));
    table.numbers.emplace_back();
    for (std::size_t column = 0; column < columns; ++column)
      table.numbers.back().push_back(std::round(random.real(-1e7, 1e7)) / 1e4);
  }
  return table;
}

inline std::string separator_of(Delimiter delimiter) {
  switch (delimiter) {
    case Delimiter::comma:
      return ",";
    case Delimiter::semicolon:
      return ";";
    case Delimiter::tab:
      return "\t";
    case Delimiter::blanks:
      break;
  }
  return "   ";
}

inline std::string column_name(std::size_t column) {
  return std::string(1, static_cast<char>('A' + column));
}

inline std::string written(const RandomTable& table, const Habit& habit) {
  const std::string end = habit.returns ? "\r\n" : "\n", quote = habit.quotes ? "\"" : "";
  const std::string separator = separator_of(habit.delimiter);
  const auto field = [&](const std::string& text) { return quote + text + quote; };
  std::ostringstream text;
  for (int line = 0; line < habit.preamble; ++line) text << "Measured by somebody on a day without number" << end;
  if (habit.headings) {
    text << field("Name");
    for (std::size_t column = 0; column < table.numbers[0].size(); ++column)
      text << separator << field(column_name(column) + (habit.units ? " [mm]" : ""));
    text << end;
  }
  for (std::size_t row = 0; row < table.names.size(); ++row) {
    if (habit.comments && row % 3 == 1) text << "# a remark" << end << end;
    text << field(table.names[row]);
    for (const double number : table.numbers[row]) {
      std::string digits = number_text(number);
      if (habit.decimal == ',') std::ranges::replace(digits, '.', ',');
      text << separator << field(digits);
    }
    text << end;
  }
  return text.str();
}

/// The text as UTF-16, with a byte order mark or without; letters of ASCII alone.
inline std::string as_utf16(const std::string& text, bool little, bool mark) {
  std::string bytes = !mark ? "" : little ? "\xFF\xFE" : "\xFE\xFF";
  for (const char c : text) {
    if (little) bytes += c;
    bytes += '\0';
    if (!little) bytes += c;
  }
  return bytes;
}

}  // namespace demecal
