#include "parsed_programs/payload_values.hpp"

#include <algorithm>
#include <string>

#include "data/text.hpp"
#include "parsed_programs/program_text.hpp"

namespace demecal::inline parsed_programs {
namespace {

constexpr std::string_view kLineBlanks = " \t";

std::size_t behind_blanks(std::string_view code, std::size_t at) {
  return std::min(code.find_first_not_of(kLineBlanks, at), code.size());
}

/// Where `words` end that stand at `at`, blanks between them or not; npos: something else stands there.
std::size_t behind_words(std::string_view code, std::size_t at, std::string_view words) {
  for (const char letter : words) {
    if (letter == ' ') continue;
    at = behind_blanks(code, at);
    if (at >= code.size() || code[at] != letter) return std::string_view::npos;
    ++at;
  }
  return at;
}

}  // namespace

std::optional<double> number_argument(std::string_view code, std::size_t at) {
  constexpr std::string_view kEnds = ",)]};\r\n!#";
  const std::size_t begin = behind_blanks(code, at), end = std::min(code.find_first_of(kEnds, begin), code.size());
  std::string_view text = code.substr(begin, end - begin);
  text = text.substr(0, text.find_last_not_of(kLineBlanks) + 1);
  const auto value = parse_number(text);
  return value && *value >= 0.0 ? value : std::nullopt;
}

std::string_view load_name(std::string_view code, std::size_t at) {
  const std::size_t begin = behind_blanks(code, at);
  std::size_t end = begin;
  while (end < code.size() && (is_word_letter(code[end]) || is_digit(code[end]))) ++end;
  if (end == begin || end == code.size() || code[end] != '[') return code.substr(begin, end - begin);
  std::size_t close = end + 1;
  while (close < code.size() && is_digit(code[close])) ++close;
  const bool closed = close > end + 1 && close < code.size() && code[close] == ']';
  return closed ? code.substr(begin, close + 1 - begin) : std::string_view{};
}

std::optional<double> declared_load_kg(std::string_view code, std::string_view name, std::string_view sign,
                                       std::string_view opening) {
  std::optional<double> kg;
  bool given = false;
  const auto in_word = [&](std::size_t at) {
    return at < code.size() && (is_word_letter(code[at]) || is_digit(code[at]) || code[at] == '$');
  };
  for (std::size_t at = code.find(name); !name.empty() && at != std::string_view::npos; at = code.find(name, at + 1)) {
    const std::size_t end = at + name.size();
    if ((at > 0 && in_word(at - 1)) || in_word(end)) continue;
    const std::size_t next = behind_blanks(code, end);
    if (next < code.size() && code[next] == '.') return std::nullopt;  // a part of it may be given another value
    const std::size_t value = behind_words(code, end, sign);
    if (value == std::string_view::npos || (value < code.size() && code[value] == '=')) continue;
    const std::size_t number = behind_words(code, value, opening);
    const bool again = given;
    given = true;
    if (again || number == std::string_view::npos) return std::nullopt;
    kg = number_argument(code, number);
  }
  return kg;
}

}  // namespace demecal::inline parsed_programs
