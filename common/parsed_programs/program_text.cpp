#include "parsed_programs/program_text.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <iterator>
#include <utility>

#include "data/text.hpp"
#include "errors/check.hpp"
#include "errors/input_error.hpp"

namespace demecal::inline parsed_programs {

ProgramSource::ProgramSource(std::string_view text, std::string file)
    : ProgramSource(std::vector<ProgramFile>{{std::move(file), std::string(text)}}) {}

ProgramSource::ProgramSource(std::vector<ProgramFile> files) : files_(std::move(files)) {
  constexpr std::string_view kByteOrderMark = "\xEF\xBB\xBF";
  DEMECAL_CHECK(!files_.empty(), "a program has a file");
  for (const ProgramFile& file : files_) {
    if (!begins_.empty()) text_ += '\n';
    begins_.push_back(text_.size());
    text_ += file.text;
    if (begins_.size() > 1 && file.text.starts_with(kByteOrderMark)) text_.replace(begins_.back(), 3, 3, ' ');
  }
}

std::size_t ProgramSource::file_at(std::size_t offset) const {
  return static_cast<std::size_t>(std::upper_bound(begins_.begin(), begins_.end(), offset) - begins_.begin()) - 1;
}

namespace {

constexpr int kMostDecimals = 15;

/// Digits behind the point of a number as written, its exponent taken in.
int decimals_of(std::string_view number) {
  const std::size_t mark = std::min(number.find_first_of("eE"), number.size());
  const std::size_t point = number.substr(0, mark).find('.');
  int decimals = point == std::string_view::npos ? 0 : static_cast<int>(mark - point - 1);
  if (mark < number.size()) {
    const double exponent = parse_number(number.substr(mark + 1)).value_or(0.0);
    decimals -= static_cast<int>(std::clamp(exponent, -400.0, 400.0));
  }
  return std::clamp(decimals, 0, kMostDecimals);
}

constexpr std::string_view kSpaces = " \t\r\n\f\v";

bool is_letter(char letter) {
  return (letter >= 'a' && letter <= 'z') || (letter >= 'A' && letter <= 'Z') || letter == '_' || letter == '$';
}

/// Where the line that `offset` is in ends, its line break left out.
std::size_t line_end(std::string_view text, std::size_t offset) {
  return std::min(text.find_first_of("\r\n", offset), text.size());
}

std::string blanked(std::string_view text, CommentStyle style) {
  std::string code(text);
  const auto blank = [&](std::size_t begin, std::size_t end) {
    std::fill(code.begin() + static_cast<std::ptrdiff_t>(begin), code.begin() + static_cast<std::ptrdiff_t>(end), ' ');
  };
  if (text.starts_with("\xEF\xBB\xBF")) blank(0, 3);
  for (std::size_t i = 0; i < text.size(); ++i) {
    const bool starts_line = i == 0 || text[i - 1] == '\n';
    if (text[i] == style.comment || (starts_line && style.line != '\0' && text[i] == style.line)) {
      const std::size_t end = line_end(text, i);
      blank(i, end);
      i = end;
    } else if (text[i] == '"' && style.strings) {
      const std::size_t end = line_end(text, i);
      const std::size_t quote = i + 1 + std::min(text.substr(i + 1, end - i - 1).find('"'), end - i - 1);
      blank(i + 1, quote);
      i = quote;
    }
  }
  return code;
}

constexpr int kDeepestBracket = 20;

class ListReader {
 public:
  ListReader(const ProgramText& text, char opening)
      : text_(text), code_(text.code()), opening_(opening), closing_(opening == '[' ? ']' : '}') {}

  BracketItem list(std::size_t begin, int depth) const {
    if (depth > kDeepestBracket) text_.fail(begin, 1, "is nested too deeply");
    BracketItem whole{begin, 0, true, {}};
    std::size_t at = begin + 1;
    while (true) {
      whole.items.push_back(item(at, depth));
      if (at >= code_.size()) text_.fail(begin, code_.size() - begin, "opens a bracket that is never closed");
      if (code_[at++] == closing_) break;
    }
    whole.size = at - begin;
    if (whole.items.size() == 1 && whole.items.front().size == 0) whole.items.clear();
    return whole;
  }

 private:
  /// The item from `at` up to the comma or bracket after it, where `at` then stands.
  BracketItem item(std::size_t& at, int depth) const {
    at = text_.skip_spaces(at);
    if (at < code_.size() && code_[at] == opening_) {
      BracketItem inner = list(at, depth + 1);
      const std::size_t after = text_.skip_spaces(inner.begin + inner.size);
      if (after >= code_.size() || code_[after] == ',' || code_[after] == closing_) {
        at = after;
        return inner;
      }
    }
    const std::size_t begin = at;
    int parentheses = 0, brackets = 0;
    for (; at < code_.size(); ++at) {
      const char letter = code_[at];
      if (brackets == 0 && (letter == closing_ || (letter == ',' && parentheses <= 0))) break;
      parentheses += letter == '(' ? 1 : letter == ')' ? -1 : 0;
      brackets += letter == opening_ ? 1 : letter == closing_ ? -1 : 0;
    }
    std::size_t first = begin;
    const std::string_view value = text_.trimmed(first, at);
    return {first, value.size(), false, {}};
  }

  const ProgramText& text_;
  std::string_view code_;
  char opening_, closing_;
};

}  // namespace

std::optional<Cell> cell_at(std::string_view text, std::size_t begin, std::size_t size, const CellUnit& unit) {
  const std::string_view number = text.substr(begin, size);
  const std::optional<double> value = parse_number(number);
  if (!value) return std::nullopt;
  return Cell{begin, size, *value, unit.size, std::max(decimals_of(number), unit.least_decimals)};
}

std::optional<std::string> rewritten(const Cell& cell, double inside) {
  std::array<char, 400> buffer;  // the largest number has 309 digits before its point
  const auto written = std::to_chars(buffer.data(), buffer.data() + buffer.size(), inside / cell.unit,
                                     std::chars_format::fixed, cell.decimals);
  std::string text(buffer.data(), written.ptr);
  const std::optional<double> value = parse_number(text);
  if (!value || *value == cell.value) return std::nullopt;
  if (*value == 0.0 && text.front() == '-') text.erase(0, 1);
  return text;
}

bool is_digit(char letter) {
  return letter >= '0' && letter <= '9';
}

bool is_word_letter(char letter) {
  return is_letter(letter) || is_digit(letter);
}

bool is_expression(std::string_view text) {
  constexpr std::string_view kSigns = "+-";
  for (std::size_t at = text.find_first_of(kSigns, 1); at < text.size(); at = text.find_first_of(kSigns, at + 1))
    if (text[at - 1] != 'e' && text[at - 1] != 'E') return true;  // of no exponent
  return !text.empty() && (is_letter(text.front()) || text.find_first_of("(*/") != std::string_view::npos ||
                           (text.size() > 1 && text.front() == '-' && is_letter(text[1])));
}

ProgramText::ProgramText(const ProgramSource& source, CommentStyle style)
    : source_(source), code_(blanked(source.text(), style)) {
  for (std::size_t i = 0; i < code_.size(); ++i) {
    if (text()[i] == '\n') line_starts_.push_back(i + 1);
  }
}

TextPlace ProgramText::place(std::size_t offset) const {
  const auto line_at = [&](std::size_t at) {
    return std::prev(std::upper_bound(line_starts_.begin(), line_starts_.end(), at));
  };
  const std::size_t file = source_.file_at(offset);
  const auto line = line_at(offset), first = line_at(source_.begin(file));
  return {static_cast<std::size_t>(line - first) + 1, offset - *line + 1, file};
}

void ProgramText::fail(std::size_t begin, std::size_t size, const std::string& rule) const {
  constexpr std::size_t kMostShown = 40;
  const TextPlace at = place(begin);
  const std::size_t end = line_end(text(), begin);
  size = std::min(size, end - std::min(begin, end));
  std::string value(text().substr(std::min(begin, text().size()), std::min(size, kMostShown)));
  if (size > kMostShown) value += "...";
  throw InputError({source_.files()[at.file].name, at.line}, value,
                   rule + " (column " + std::to_string(at.column) + ')');
}

Cell ProgramText::number(std::size_t begin, std::size_t size, const CellUnit& unit) const {
  const std::optional<Cell> cell = cell_at(text(), begin, size, unit);
  if (!cell) fail(begin, size, size == 0 ? "a number is missing" : "must be a number");
  return *cell;
}

std::size_t ProgramText::skip_spaces(std::size_t offset) const {
  return std::min(code_.find_first_not_of(kSpaces, offset), code_.size());
}

std::size_t ProgramText::word_end(std::size_t offset) const {
  while (offset < code_.size() && is_word_letter(code_[offset])) ++offset;
  return offset;
}

bool ProgramText::begins_word(std::size_t offset) const {
  return is_letter(code_[offset]) && (offset == 0 || !is_word_letter(code_[offset - 1]));
}

std::string_view ProgramText::trimmed(std::size_t& begin, std::size_t end) const {
  begin = std::min(skip_spaces(begin), end);
  const std::string_view all = std::string_view(code_).substr(begin, end - begin);
  return all.substr(0, all.find_last_not_of(kSpaces) + 1);
}

BracketItem read_list(const ProgramText& text, std::size_t begin, char opening) {
  return ListReader(text, opening).list(begin, 1);
}

char ProgramText::next(std::size_t offset) const {
  offset = skip_spaces(offset);
  return offset < code_.size() ? code_[offset] : '\0';
}

std::size_t ProgramText::option_sign(std::size_t begin) const {
  if (begin == 0) return std::string_view::npos;
  const std::size_t before = code_.find_last_not_of(" \t\r\n", begin - 1);
  return before != std::string_view::npos && code_[before] == '\\' ? before : std::string_view::npos;
}

std::string ProgramText::word_at(std::size_t offset) const {
  const std::size_t begin = skip_spaces(offset);
  return lower_case(code_.substr(begin, word_end(begin) - begin));
}

std::optional<std::vector<double>> list_numbers(const ProgramText& text, const BracketItem& list, std::size_t size) {
  if (!list.is_list || list.items.size() != size) return std::nullopt;
  std::vector<double> values;
  for (const BracketItem& item : list.items) {
    const auto cell = cell_at(text.text(), item.begin, item.size, {});
    if (!cell) return std::nullopt;
    values.push_back(cell->value);
  }
  return values;
}

}  // namespace demecal::inline parsed_programs
