// Tables as comma-separated text: a strict reader that remembers lines, and a writer.
#pragma once

#include <cstddef>
#include <iosfwd>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace demecal::inline data {

struct CsvRow {
  std::size_t line = 0;             ///< in the file, from 1
  std::vector<std::string> fields;  ///< without quotes and surrounding spaces; one per column
};

struct CsvTable {
  std::string file;                  ///< as named to the user
  std::size_t header_line = 0;       ///< in the file, from 1
  std::vector<std::string> columns;  ///< all different, none empty, where the table is one of read_csv()
  std::vector<CsvRow> rows;          ///< at least one after reading
  char decimal = '.';                ///< point or comma
  /// What tables of other programs have beside it, one a column; empty: nothing of the kind.
  std::vector<std::string> units{};     ///< as the heading gives them, without brackets: "mm"; empty where it does not
  std::vector<std::string> headings{};  ///< as they stand in the file, unit and all

  /// Index of the column of that name or heading, if there is one.
  std::optional<std::size_t> find(std::string_view column) const;
};

/// The table in `text`: a header row, then rows of as many fields, comma separated. Lines may end in CR LF, fields may
/// be quoted (a doubled quote stands for one) and padded with spaces; blank lines, lines that begin with # and a UTF-8
/// byte order mark are skipped. Throws InputError{file, line, value, rule} at the first fault.
CsvTable read_csv(std::istream& text, const std::string& file);

/// Writes the table in a form read_csv() reads back the same, whatever its fields hold but line breaks.
std::string csv_text(const CsvTable& table);

}  // namespace demecal::inline data
