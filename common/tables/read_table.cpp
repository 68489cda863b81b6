#include "tables/read_table.hpp"

#include <algorithm>
#include <cstddef>
#include <optional>
#include <sstream>
#include <utility>
#include <vector>

#include "data/text.hpp"
#include "errors/input_error.hpp"
#include "tables/headings.hpp"

namespace demecal::inline tables {
namespace {

void refuse_lone_returns(std::string_view text, const std::string& file) {
  std::size_t line = 1;
  for (std::size_t at = 0; at < text.size(); ++at) {
    if (text[at] == '\n') ++line;
    if (text[at] == '\r' && (at + 1 == text.size() || text[at + 1] != '\n') && at + 1 != text.size())
      throw InputError({file, line}, "", "lines must end in LF or CR LF, not in CR");
  }
}

/// The separator that spreadsheets state in a first line "sep=;", which is then taken off the lines.
std::optional<Delimiter> stated_separator(std::vector<TextLine>& lines) {
  constexpr std::string_view kMark = "sep=";
  if (lines.empty() || !lower_case(lines.front().text).starts_with(kMark) ||
      lines.front().text.size() != kMark.size() + 1)
    return std::nullopt;
  const char sign = lines.front().text.back();
  const auto delimiter = sign == ';'    ? std::optional(Delimiter::semicolon)
                         : sign == ','  ? std::optional(Delimiter::comma)
                         : sign == '\t' ? std::optional(Delimiter::tab)
                                        : std::nullopt;
  if (delimiter) lines.erase(lines.begin());
  return delimiter;
}

std::vector<CsvRow> rows_of(const std::vector<TextLine>& lines, const Layout& layout, const Headings& headings,
                            const std::string& file) {
  std::vector<CsvRow> rows;
  for (std::size_t i = layout.first_row; i < lines.size(); ++i) {
    const TextLine& line = lines[i];
    if (line.comment) continue;
    CsvRow row{line.number, fields_of(line.text, layout.delimiter)};
    const auto open = std::ranges::find_if(row.fields, [](const std::string& field) { return field.starts_with('"'); });
    if (open != row.fields.end())
      throw InputError({file, line.number}, *open, "opens a quote that does not end with its field");
    if (row.fields.size() == layout.width) {
      rows.push_back(std::move(row));
      continue;
    }
    if (headings.line > 0 && layout.delimiter == Delimiter::comma) refuse_half_headings(layout.width, row, file);
    throw InputError({file, line.number}, "",
                     "the row has " + std::to_string(row.fields.size()) + " fields, but " +
                         (headings.line > 0 ? "the header has " : "the other rows have ") +
                         std::to_string(layout.width) + (headings.line > 0 ? " columns" : "") +
                         "; a line that is no row of the table can be marked by # as a comment");
  }
  return rows;
}

/// A last column without a name and without fields is none: its rows end in a separator.
void drop_empty_last_column(Headings& headings, Layout& layout, std::vector<CsvRow>& rows) {
  if (headings.line > 0 && !headings.fields.back().empty()) return;
  const auto ends_empty = [](const CsvRow& row) { return row.fields.back().empty(); };
  if (!std::ranges::all_of(rows, ends_empty)) return;
  for (CsvRow& row : rows) row.fields.pop_back();
  if (headings.line > 0) headings.fields.pop_back();
  if (!headings.units.empty()) headings.units.pop_back();
  --layout.width;
}

/// Headings that lack a name for a column with fields.
void require_names(const Headings& headings, const std::vector<CsvRow>& rows, const std::string& file) {
  if (headings.line == 0 || !headings.fields.back().empty() || rows.front().fields.back().empty()) return;
  throw InputError({file, headings.line}, "",
                   "there are " + std::to_string(headings.fields.size() - 1) + " headings, but the rows have " +
                       std::to_string(headings.fields.size()) + " fields");
}

std::string description(const CsvTable& table, const Layout& layout, const Headings& headings,
                        const std::string& encoding) {
  std::string text = layout.delimiter == Delimiter::comma       ? "commas"
                     : layout.delimiter == Delimiter::semicolon ? "semicolons"
                     : layout.delimiter == Delimiter::tab       ? "tabs"
                                                                : "blanks";
  text += " between " + counted(layout.width, "column");
  text += table.decimal == ',' ? ", decimal commas" : ", decimal points";
  if (!encoding.empty()) text += ", " + encoding;
  if (headings.line == 0) text += ", no headings (columns go by their numbers)";
  if (headings.line > 0) text += ", headings in line " + std::to_string(headings.line);
  if (headings.in_comment) text += " (a comment)";
  if (std::ranges::any_of(table.units, [](const std::string& unit) { return !unit.empty(); })) text += " with units";
  if (headings.lines_before > 0) text += ", " + counted(headings.lines_before, "line") + " before them left out";
  return text + ", " + counted(table.rows.size(), "row");
}

/// Whether the table is CSV as demecal writes it: its strict reader then says what is wrong with it.
bool is_plain(const std::vector<TextLine>& lines, const std::optional<Layout>& layout, const std::string& encoding) {
  if (!encoding.empty() || (layout && layout->delimiter != Delimiter::comma)) return false;
  const auto plain_comment = [](const TextLine& line) {
    return !line.comment || line.text.substr(line.text.find_first_not_of(" \t")).starts_with('#');
  };
  if (!std::ranges::all_of(lines, plain_comment)) return false;
  const auto first = std::ranges::find(lines, false, &TextLine::comment);
  if (first == lines.end() || !layout) return true;
  const std::vector<std::string> names = fields_of(first->text, Delimiter::comma);
  const auto next = std::find_if(first + 1, lines.end(), [](const TextLine& line) { return !line.comment; });
  return next != lines.end() && next == lines.begin() + static_cast<std::ptrdiff_t>(layout->first_row) &&
         names.size() == layout->width && std::ranges::none_of(names, is_numeric);
}

bool has_units(const CsvTable& table) {
  return std::ranges::any_of(table.units, [](const std::string& unit) { return !unit.empty(); });
}

}  // namespace

RecognisedTable read_table(std::string_view bytes, const std::string& file, const ToldLayout& told) {
  const DecodedText decoded = decode_text(bytes, file);
  refuse_lone_returns(decoded.text, file);
  std::vector<TextLine> lines = lines_of(decoded.text);
  ToldLayout known = told;
  if (const auto separator = stated_separator(lines); separator && !known.delimiter) known.delimiter = separator;
  std::optional<Layout> layout = recognise_layout(lines, known, file);
  const bool told_nothing = !known.delimiter && !known.decimal && !known.header_line;
  if (!layout && !told_nothing)
    throw InputError({file, 0}, "", "has no line of several columns with numbers, separated as told");
  const bool plain = told_nothing && is_plain(lines, layout, decoded.encoding);
  if (!layout || plain) {
    std::istringstream text(decoded.text);
    CsvTable table = read_csv(text, file);
    Headings headings{.line = table.header_line, .fields = table.columns, .units = {}};
    CsvTable headed;
    set_columns(headings, table.columns.size(), headed);
    const char sign = layout ? decimal_sign(table.rows, file) : '.';
    if (sign == '.' && !has_units(headed)) return {std::move(table), ""};
    table.columns = headed.columns;
    table.units = headed.units;
    table.headings = headed.headings;
    table.decimal = sign;
    const std::string found = description(table, *layout, headings, "");
    return {std::move(table), found};
  }
  Headings headings = find_headings(lines, *layout, known, file);
  std::vector<CsvRow> rows = rows_of(lines, *layout, headings, file);
  drop_empty_last_column(headings, *layout, rows);
  require_names(headings, rows, file);
  if (layout->delimiter == Delimiter::comma && headings.line == 0 && !known.decimal) refuse_split_decimals(rows, file);
  CsvTable table{.file = file, .header_line = headings.line, .columns = {}, .rows = std::move(rows)};
  table.decimal = known.decimal.value_or('.');
  if (!known.decimal) table.decimal = decimal_sign(table.rows, file);
  const bool thousands = take_thousands_together(table.rows, table.decimal);
  set_columns(headings, layout->width, table);
  const std::string found =
      description(table, *layout, headings, decoded.encoding) + (thousands ? ", separators of thousands left out" : "");
  return {std::move(table), found};
}

}  // namespace demecal::inline tables
