#include "tables/layout.hpp"

#include <algorithm>
#include <array>
#include <functional>
#include <map>
#include <utility>

#include "data/text.hpp"
#include "errors/input_error.hpp"

namespace demecal::inline tables {
namespace {

constexpr std::string_view kBlanks = " \t";
constexpr std::size_t kLinesJudged = 2000;

bool is_comment(std::string_view line) {
  const std::string_view text = trimmed(line);
  return text.starts_with('#') || text.starts_with('%') || text.starts_with('!') || text.starts_with("//");
}

bool separates(char c, Delimiter delimiter) {
  switch (delimiter) {
    case Delimiter::comma:
      return c == ',';
    case Delimiter::semicolon:
      return c == ';';
    case Delimiter::tab:
      return c == '\t';
    case Delimiter::blanks:
      return c == ' ' || c == '\t';
  }
  return false;
}

/// The place after the quoted field that begins the text, with its content; nothing where the quote stays open.
std::optional<std::pair<std::size_t, std::string>> unquoted_field(std::string_view text) {
  std::string content;
  for (std::size_t at = 1; at < text.size(); ++at) {
    if (text[at] != '"') {
      content += text[at];
    } else if (at + 1 < text.size() && text[at + 1] == '"') {
      content += '"';
      ++at;
    } else {
      return std::pair{at + 1, content};
    }
  }
  return std::nullopt;
}

/// Takes a field, and what separates it from the next, off the text. `more`: another follows.
std::string take_field(std::string_view& text, Delimiter delimiter, bool& more) {
  const std::string_view padding = delimiter == Delimiter::tab ? " " : kBlanks;
  text.remove_prefix(std::min(text.find_first_not_of(padding), text.size()));
  const auto quoted = text.starts_with('"') ? unquoted_field(text) : std::nullopt;
  std::size_t end = quoted ? quoted->first : 0;
  while (end < text.size() && !separates(text[end], delimiter)) ++end;
  const bool closed = quoted && trimmed(text.substr(quoted->first, end - quoted->first)).empty();
  std::string field = closed ? quoted->second : std::string(trimmed(text.substr(0, end)));
  text.remove_prefix(end);
  if (delimiter == Delimiter::blanks) text.remove_prefix(std::min(text.find_first_not_of(kBlanks), text.size()));
  more = !text.empty();
  if (more && delimiter != Delimiter::blanks) text.remove_prefix(1);
  return field;
}

std::size_t count_numeric(const std::vector<std::string>& fields) {
  return static_cast<std::size_t>(std::ranges::count_if(fields, is_numeric));
}

/// How well a separator explains the lines.
struct LayoutScore {
  Layout layout;
  double score = 0.0;
};

struct SplitLine {
  std::size_t fields = 0, numeric = 0;
};

/// The width that most lines with numbers have, the first of equals.
std::size_t usual_width(const std::vector<SplitLine>& lines) {
  std::map<std::size_t, std::size_t> count;
  std::size_t most = 0;
  const auto has_numbers = [](const SplitLine& line) { return line.numeric > 0 && line.fields > 1; };
  for (const SplitLine& line : lines) {
    if (has_numbers(line)) most = std::max(most, ++count[line.fields]);
  }
  const auto usual = std::ranges::find_if(
      lines, [&](const SplitLine& line) { return has_numbers(line) && count[line.fields] == most; });
  return usual == lines.end() ? 0 : usual->fields;
}

LayoutScore explain(const std::vector<TextLine>& lines, Delimiter delimiter) {
  std::vector<SplitLine> split;
  for (const TextLine& line : lines) {
    if (split.size() == kLinesJudged) break;
    if (line.comment) {
      split.push_back({});
      continue;
    }
    const std::vector<std::string> fields = fields_of(line.text, delimiter);
    split.push_back({fields.size(), count_numeric(fields)});
  }
  const std::size_t width = usual_width(split);
  const auto is_row = [&](const SplitLine& line) { return line.fields == width && line.numeric > 0; };
  const auto first = std::ranges::find_if(split, is_row);
  if (width < 2 || first == split.end()) return {};
  std::size_t rows = 0, numeric = 0, all = 0;
  for (const SplitLine& line : split) {
    if (line.fields > 0) ++all;
    if (!is_row(line)) continue;
    ++rows;
    numeric += line.numeric;
  }
  const double regular = static_cast<double>(rows) / static_cast<double>(all);
  const double numbers = static_cast<double>(numeric) / static_cast<double>(rows * width);
  return {{delimiter, width, static_cast<std::size_t>(first - split.begin())}, regular * numbers};
}

/// Whether two separators make the same rows: then nothing hangs on the choice.
bool same_rows(const std::vector<TextLine>& lines, const Layout& a, const Layout& b) {
  if (a.width != b.width || a.first_row != b.first_row) return false;
  return std::ranges::all_of(lines.begin() + static_cast<std::ptrdiff_t>(a.first_row), lines.end(),
                             [&](const TextLine& line) {
                               if (line.comment) return true;
                               const auto of_a = fields_of(line.text, a.delimiter);
                               const auto of_b = fields_of(line.text, b.delimiter);
                               return of_a.size() != a.width || of_b.size() != b.width || of_a == of_b;
                             });
}

}  // namespace

std::string_view trimmed(std::string_view text) {
  const std::size_t first = text.find_first_not_of(kBlanks);
  return first == std::string_view::npos ? "" : text.substr(first, text.find_last_not_of(kBlanks) + 1 - first);
}

std::string_view to_string(Delimiter delimiter) {
  constexpr std::array<std::string_view, 4> kNames{"comma", "semicolon", "tab", "blanks"};
  return kNames[static_cast<std::size_t>(delimiter)];
}

std::vector<TextLine> lines_of(std::string_view text) {
  std::vector<TextLine> lines;
  for (std::size_t number = 1; !text.empty(); ++number) {
    const std::size_t end = std::min(text.find('\n'), text.size());
    std::string_view line = text.substr(0, end);
    if (line.ends_with('\r')) line.remove_suffix(1);
    if (!trimmed(line).empty()) lines.push_back({number, line, is_comment(line)});
    text.remove_prefix(std::min(end + 1, text.size()));
  }
  return lines;
}

std::vector<std::string> fields_of(std::string_view line, Delimiter delimiter) {
  std::vector<std::string> fields;
  if (delimiter == Delimiter::blanks) line = trimmed(line);
  for (bool more = true; more;) fields.push_back(take_field(line, delimiter, more));
  return fields;
}

bool is_numeric(std::string_view field) {
  if (parse_number(field) || has_thousands_and_decimals(field)) return true;
  if (field.find('.') != std::string_view::npos || std::ranges::count(field, ',') != 1) return false;
  std::string pointed(field);
  std::ranges::replace(pointed, ',', '.');
  return parse_number(pointed).has_value();
}

std::optional<Layout> recognise_layout(const std::vector<TextLine>& lines, const ToldLayout& told,
                                       const std::string& file) {
  constexpr double kAlike = 0.9;
  if (told.delimiter) {
    const LayoutScore only = explain(lines, *told.delimiter);
    return only.score > 0.0 ? std::optional(only.layout) : std::nullopt;
  }
  std::vector<LayoutScore> found;
  for (const Delimiter delimiter : {Delimiter::tab, Delimiter::semicolon, Delimiter::comma, Delimiter::blanks}) {
    const LayoutScore explanation = explain(lines, delimiter);
    if (explanation.score > 0.0) found.push_back(explanation);
  }
  if (found.empty()) return std::nullopt;
  std::ranges::stable_sort(found, std::greater(), &LayoutScore::score);
  const Layout& best = found.front().layout;
  for (std::size_t i = 1; i < found.size(); ++i) {
    const Layout& rival = found[i].layout;
    if (found[i].score < kAlike * found.front().score) break;
    if (same_rows(lines, best, rival)) continue;
    throw InputError({file, lines[best.first_row].number}, "",
                     "may have " + std::to_string(best.width) + " columns, separated by " +
                         std::string(to_string(best.delimiter)) + ", or " + std::to_string(rival.width) +
                         ", separated by " + std::string(to_string(rival.delimiter)) +
                         ": say which by `delimiter` beside the file's name");
  }
  return best;
}

}  // namespace demecal::inline tables
