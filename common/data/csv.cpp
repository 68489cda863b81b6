#include "data/csv.hpp"

#include <algorithm>
#include <istream>
#include <ostream>
#include <sstream>
#include <utility>

#include "errors/check.hpp"
#include "errors/input_error.hpp"

namespace demecal::inline data {
namespace {

constexpr std::string_view kFieldPadding = " \t";
constexpr std::string_view kByteOrderMark = "\xEF\xBB\xBF";

void skip_spaces(std::string_view& rest) {
  rest.remove_prefix(std::min(rest.find_first_not_of(kFieldPadding), rest.size()));
}

/// Takes the quoted field that `rest` begins with off it, up to the next comma or the end.
std::string take_quoted(std::string_view& rest, const InputError::Where& where) {
  const std::string whole(rest);
  std::string field;
  rest.remove_prefix(1);
  while (true) {
    const std::size_t quote = rest.find('"');
    if (quote == std::string_view::npos) throw InputError(where, whole, "opens a quote that its line does not close");
    field += rest.substr(0, quote);
    rest.remove_prefix(quote + 1);
    if (!rest.starts_with('"')) break;
    field += '"';
    rest.remove_prefix(1);
  }
  skip_spaces(rest);
  if (!rest.empty() && rest.front() != ',') throw InputError(where, whole, "has text after a closing quote");
  return field;
}

std::string take_plain(std::string_view& rest) {
  std::string_view field = rest.substr(0, rest.find(','));
  rest.remove_prefix(field.size());
  field = field.substr(0, field.find_last_not_of(kFieldPadding) + 1);
  return std::string(field);
}

std::vector<std::string> split_line(std::string_view rest, const InputError::Where& where) {
  std::vector<std::string> fields;
  while (true) {
    skip_spaces(rest);
    fields.push_back(rest.starts_with('"') ? take_quoted(rest, where) : take_plain(rest));
    if (rest.empty()) return fields;
    rest.remove_prefix(1);
  }
}

bool is_skipped(std::string_view line) {
  skip_spaces(line);
  return line.empty() || line.front() == '#';
}

void check_header(const std::vector<std::string>& columns, const InputError::Where& where) {
  for (std::size_t i = 0; i < columns.size(); ++i) {
    if (columns[i].empty()) {
      throw InputError(where, "", "column " + std::to_string(i + 1) + " of the header has no name");
    }
    if (std::find(columns.begin(), columns.begin() + static_cast<std::ptrdiff_t>(i), columns[i]) !=
        columns.begin() + static_cast<std::ptrdiff_t>(i)) {
      throw InputError(where, columns[i], "is the name of two columns; names must differ");
    }
  }
  if (columns.size() == 1 && columns.front().find_first_of(";\t") != std::string::npos) {
    throw InputError(where, columns.front(),
                     "columns must be separated by commas; other separators are recognised where most fields are plain "
                     "numbers, with "
                     "their units (deg, mm) in the headings alone");
  }
}

void check_width(const CsvRow& row, std::size_t columns, const InputError::Where& where) {
  if (row.fields.size() == columns) return;
  throw InputError(where, "",
                   "the row has " + std::to_string(row.fields.size()) + " fields, but the header has " +
                       std::to_string(columns) + " columns");
}

void write_field(std::ostream& text, const std::string& field) {
  DEMECAL_CHECK(field.find_first_of("\r\n") == std::string::npos, "field=" << field);
  const bool padded = !field.empty() && (kFieldPadding.find(field.front()) != std::string_view::npos ||
                                         kFieldPadding.find(field.back()) != std::string_view::npos);
  // An empty or # beginning would make the line look blank or a comment.
  const bool quoted = padded || field.empty() || field.front() == '#' ||
                      field.find_first_of(",\"") != std::string::npos || field.starts_with(kByteOrderMark);
  if (!quoted) {
    text << field;
    return;
  }
  text << '"';
  for (const char letter : field) text << (letter == '"' ? "\"\"" : std::string(1, letter));
  text << '"';
}

void write_line(std::ostream& text, const std::vector<std::string>& fields) {
  for (std::size_t i = 0; i < fields.size(); ++i) {
    if (i > 0) text << ',';
    write_field(text, fields[i]);
  }
  text << '\n';
}

}  // namespace

std::optional<std::size_t> CsvTable::find(std::string_view column) const {
  for (const std::vector<std::string>* names : {&columns, &headings}) {
    const auto found = std::find(names->begin(), names->end(), column);
    if (found != names->end()) return static_cast<std::size_t>(found - names->begin());
  }
  return std::nullopt;
}

CsvTable read_csv(std::istream& text, const std::string& file) {
  CsvTable table{.file = file, .header_line = 0, .columns = {}, .rows = {}};
  InputError::Where where{file, 0};
  for (std::string line; std::getline(text, line);) {
    ++where.line;
    if (where.line == 1 && line.starts_with(kByteOrderMark)) line.erase(0, kByteOrderMark.size());
    if (line.ends_with('\r')) line.pop_back();
    if (line.find('\r') != std::string::npos) throw InputError(where, "", "lines must end in LF or CR LF, not in CR");
    if (is_skipped(line)) continue;
    CsvRow row{where.line, split_line(line, where)};
    if (table.columns.empty()) {
      check_header(row.fields, where);
      table.header_line = where.line;
      table.columns = std::move(row.fields);
    } else {
      check_width(row, table.columns.size(), where);
      table.rows.push_back(std::move(row));
    }
  }
  if (table.columns.empty()) throw InputError({file, 0}, "", "is empty; a header row and rows of values are expected");
  if (table.rows.empty()) throw InputError({file, table.header_line}, "", "has a header but no rows");
  return table;
}

std::string csv_text(const CsvTable& table) {
  std::ostringstream text;
  write_line(text, table.columns);
  for (const CsvRow& row : table.rows) {
    DEMECAL_CHECK(row.fields.size() == table.columns.size(), "fields=" << row.fields.size());
    write_line(text, row.fields);
  }
  return text.str();
}

}  // namespace demecal::inline data
