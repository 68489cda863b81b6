#include "tables/headings.hpp"

#include <algorithm>
#include <cstddef>
#include <optional>
#include <utility>

#include "data/columns.hpp"
#include "errors/input_error.hpp"
#include "tables/layout.hpp"

namespace demecal::inline tables {
namespace {

bool is_unit(std::string_view text) {
  return find_heading_unit(trimmed(text)).has_value();
}

}  // namespace

Heading split_heading(std::string_view text) {
  const std::string_view whole = trimmed(text);
  const auto split = [&](std::size_t at, std::string_view unit) {
    return Heading{std::string(trimmed(whole.substr(0, at))), std::string(trimmed(unit))};
  };
  for (const auto& [open, close] : {std::pair{'[', ']'}, std::pair{'(', ')'}}) {
    const std::size_t at = whole.rfind(open);
    if (!whole.ends_with(close) || at == std::string_view::npos || at == 0) continue;
    const std::string_view unit = whole.substr(at + 1, whole.size() - at - 2);
    if (open == '[' ? !trimmed(unit).empty() : is_unit(unit)) return split(at, unit);
  }
  for (const char mark : {'/', ','}) {
    const std::size_t at = whole.rfind(mark);
    if (at == std::string_view::npos || at == 0 || !is_unit(whole.substr(at + 1))) continue;
    return split(at, whole.substr(at + 1));
  }
  return {std::string(whole), ""};
}

std::string lone_unit(std::string_view field) {
  std::string_view text = trimmed(field);
  const bool square = text.starts_with('[') && text.ends_with(']');
  const bool round = text.starts_with('(') && text.ends_with(')');
  if (text.size() > 2 && (square || round)) text = trimmed(text.substr(1, text.size() - 2));
  return square || is_unit(text) ? std::string(text) : "";
}

namespace {

bool has_numbers(const std::vector<std::string>& fields) {
  return std::ranges::any_of(fields, is_numeric);
}

/// Units that stand apart from the names they belong to, as blanks separate them, joined to them: "X", "[mm]".
std::vector<std::string> with_units_joined(std::vector<std::string> fields) {
  std::vector<std::string> joined;
  for (std::string& field : fields) {
    const bool bracketed = field.size() > 2 && (field.front() == '[' || field.front() == '(');
    if (bracketed && !joined.empty() && !lone_unit(field).empty()) {
      joined.back() += ' ' + field;
    } else {
      joined.push_back(std::move(field));
    }
  }
  return joined;
}

/// The names of a line that heads the columns of `row`, nothing where it does not.
std::optional<std::vector<std::string>> names_in(std::string_view text, const Layout& layout, const TextLine& row) {
  std::vector<std::string> fields = fields_of(text, layout.delimiter);
  if (fields.size() != layout.width && layout.delimiter == Delimiter::blanks) fields = with_units_joined(fields);
  // Rows may end in a separator, and headings not.
  if (fields.size() + 1 == layout.width && fields_of(row.text, layout.delimiter).back().empty()) fields.emplace_back();
  if (fields.size() != layout.width || has_numbers(fields)) return std::nullopt;
  return fields;
}

/// The units of a line that holds nothing else; nothing where it holds something else.
std::optional<std::vector<std::string>> units_in(std::string_view text, const Layout& layout) {
  std::vector<std::string> fields = fields_of(text, layout.delimiter);
  if (fields.size() != layout.width) return std::nullopt;
  bool any = false;
  for (std::string& field : fields) {
    if (field.empty() || field == "-") {
      field.clear();
      continue;
    }
    field = lone_unit(field);
    if (field.empty()) return std::nullopt;
    any = true;
  }
  return any ? std::optional(fields) : std::nullopt;
}

std::string_view without_mark(std::string_view comment) {
  const std::size_t mark = comment.find_first_not_of(" \t");
  const std::size_t begin = comment.find_first_not_of("#%!/", mark);
  return begin == std::string_view::npos ? "" : comment.substr(begin);
}

/// Lines before the rows that are no comments, the nearest first.
std::vector<const TextLine*> lines_before(const std::vector<TextLine>& lines, std::size_t first_row) {
  std::vector<const TextLine*> before;
  for (std::size_t i = first_row; i-- > 0;) {
    if (!lines[i].comment) before.push_back(&lines[i]);
  }
  return before;
}

/// What may be the headings directly before the rows, the nearest first, and a row of units taken out.
struct NearLines {
  std::vector<std::pair<const TextLine*, std::vector<std::string>>> named;
  std::vector<std::string> units;
};
NearLines near_lines(const std::vector<const TextLine*>& before, const Layout& layout, const TextLine& row) {
  NearLines near;
  for (const TextLine* line : before) {
    if (near.named.empty() && near.units.empty()) {
      if (auto units = units_in(line->text, layout)) {
        near.units = std::move(*units);
        continue;
      }
    }
    auto names = names_in(line->text, layout, row);
    if (!names) break;
    near.named.emplace_back(line, std::move(*names));
  }
  return near;
}

/// A line directly before the rows that is of another width must be no row and no headings.
void refuse_other_width(const TextLine& line, const TextLine& row, const Layout& layout, const std::string& file) {
  const std::vector<std::string> fields = fields_of(line.text, layout.delimiter);
  const auto numeric = static_cast<std::size_t>(std::ranges::count_if(fields, is_numeric));
  if (fields.size() < 2) return;
  if (2 * numeric >= fields.size()) {
    throw InputError({file, line.number}, "",
                     "the row has " + std::to_string(fields.size()) + " fields, but those below have " +
                         std::to_string(layout.width));
  }
  if (layout.delimiter == Delimiter::blanks || numeric > 0) return;  // words before the table
  if (layout.delimiter == Delimiter::comma)
    refuse_half_headings(fields.size(), {row.number, fields_of(row.text, layout.delimiter)}, file);
  throw InputError(
      {file, line.number}, "",
      "there are " + std::to_string(fields.size()) + " headings, but the rows below have " +
          std::to_string(layout.width) +
          " fields; if the line is no part of the table, say so by `header_line: 0` beside the file's name");
}

Headings headings_at(const TextLine& line, const Layout& layout, const TextLine& row, const std::string& file) {
  const std::string_view text = line.comment ? without_mark(line.text) : line.text;
  auto names = names_in(text, layout, row);
  if (!names) {
    throw InputError({file, line.number}, "",
                     "cannot be the headings: they must be " + std::to_string(layout.width) +
                         " names and no numbers, as the rows have " + std::to_string(layout.width) + " fields");
  }
  return {.line = line.number, .fields = std::move(*names), .units = {}, .in_comment = line.comment};
}

Headings told_headings(const std::vector<TextLine>& lines, const Layout& layout, std::size_t number,
                       const std::string& file) {
  const auto found = std::ranges::find(lines, number, &TextLine::number);
  if (found == lines.end())
    throw InputError({file, number}, "", "is no line of the file with headings: it is empty, or there is none");
  Headings headings = headings_at(*found, layout, lines[layout.first_row], file);
  const auto next = std::find_if(found + 1, lines.end(), [](const TextLine& line) { return !line.comment; });
  if (next != lines.end()) headings.units = units_in(next->text, layout).value_or(std::vector<std::string>{});
  return headings;
}

}  // namespace

Headings find_headings(const std::vector<TextLine>& lines, const Layout& layout, const ToldLayout& told,
                       const std::string& file) {
  if (told.header_line)
    return *told.header_line == 0 ? Headings{} : told_headings(lines, layout, *told.header_line, file);
  const std::vector<const TextLine*> before = lines_before(lines, layout.first_row);
  const TextLine& row = lines[layout.first_row];
  NearLines near = near_lines(before, layout, row);
  if (near.named.size() > 1) {
    throw InputError({file, near.named.back().first->number}, "",
                     "and line " + std::to_string(near.named.front().first->number) +
                         " may both be the headings: say which by `header_line` beside the file's name");
  }
  Headings headings;
  headings.units = std::move(near.units);
  const std::size_t own_lines = near.named.size() + (headings.units.empty() ? 0 : 1);
  headings.lines_before = before.size() - own_lines;
  if (near.named.size() == 1) {
    headings.line = near.named.front().first->number;
    headings.fields = std::move(near.named.front().second);
    return headings;
  }
  // The comment right before the rows.
  const TextLine* comment = layout.first_row > 0 ? &lines[layout.first_row - 1] : nullptr;
  if (comment != nullptr && comment->comment && names_in(without_mark(comment->text), layout, row)) {
    Headings in_comment = headings_at(*comment, layout, row, file);
    in_comment.lines_before = before.size();
    return in_comment;
  }
  if (own_lines < before.size()) refuse_other_width(*before[own_lines], row, layout, file);
  return headings;
}

void set_columns(const Headings& headings, std::size_t width, CsvTable& table) {
  table.header_line = headings.line;
  table.headings.clear();
  for (std::size_t column = 0; column < width; ++column) {
    const std::string number = std::to_string(column + 1);
    const std::string whole = headings.line > 0 && !headings.fields[column].empty() ? headings.fields[column] : number;
    Heading heading = split_heading(whole);
    if (heading.name.empty()) heading.name = number;
    if (!headings.units.empty() && !headings.units[column].empty()) heading.unit = headings.units[column];
    table.columns.push_back(std::move(heading.name));
    table.units.push_back(std::move(heading.unit));
    table.headings.push_back(whole);
  }
}

}  // namespace demecal::inline tables
