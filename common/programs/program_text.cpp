#include "programs/program_text.hpp"

#include <algorithm>

#include "errors/input_error.hpp"

namespace demecal {
namespace {

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
    } else if (text[i] == '"') {
      const std::size_t end = line_end(text, i);
      const std::size_t quote = i + 1 + std::min(text.substr(i + 1, end - i - 1).find('"'), end - i - 1);
      blank(i + 1, quote);
      i = quote;
    }
  }
  return code;
}

}  // namespace

bool is_digit(char letter) {
  return letter >= '0' && letter <= '9';
}

bool is_word_letter(char letter) {
  return is_letter(letter) || is_digit(letter);
}

bool is_expression(std::string_view text) {
  return !text.empty() && (is_letter(text.front()) || text.find_first_of("(*/") != std::string_view::npos ||
                           (text.size() > 1 && text.front() == '-' && is_letter(text[1])));
}

ProgramText::ProgramText(std::string_view text, std::string file, CommentStyle style)
    : text_(text), file_(std::move(file)), code_(blanked(text, style)) {
  for (std::size_t i = 0; i < text_.size(); ++i) {
    if (text_[i] == '\n') line_starts_.push_back(i + 1);
  }
}

TextPlace ProgramText::place(std::size_t offset) const {
  const auto after = std::upper_bound(line_starts_.begin(), line_starts_.end(), offset);
  return {static_cast<std::size_t>(after - line_starts_.begin()), offset - *std::prev(after) + 1};
}

void ProgramText::fail(std::size_t begin, std::size_t size, const std::string& rule) const {
  constexpr std::size_t kMostShown = 40;
  const TextPlace at = place(begin);
  size = std::min(size, line_end(text_, begin) - std::min(begin, line_end(text_, begin)));
  std::string value(text_.substr(std::min(begin, text_.size()), std::min(size, kMostShown)));
  if (size > kMostShown) value += "...";
  throw InputError({file_, at.line}, value, rule + " (column " + std::to_string(at.column) + ')');
}

Cell ProgramText::number(std::size_t begin, std::size_t size, const CellUnit& unit) const {
  const std::optional<Cell> cell = cell_at(text_, begin, size, unit);
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

}  // namespace demecal
