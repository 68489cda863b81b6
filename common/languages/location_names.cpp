#include "languages/location_names.hpp"

#include <algorithm>

#include "data/text.hpp"

namespace demecal::inline languages {

std::string location_name(const ProgramText& text, std::size_t begin, std::size_t end) {
  const std::string_view code = text.code();
  std::size_t at = begin;
  if (at < end && code[at] == '#') ++at;
  const std::size_t first = at;
  while (at < end && (is_word_letter(code[at]) || code[at] == '.')) ++at;
  if (at == first || is_digit(code[first])) return "";
  if (at < end && code[at] == '[') at = std::min(code.find(']', at), end - 1) + 1;
  return std::string(code.substr(begin, at - begin));
}

std::string location_key(std::string_view name) {
  std::string key = lower_case(name);
  std::erase_if(key, [](char letter) { return letter == ' ' || letter == '\t'; });
  return key;
}

std::vector<std::string> location_names(const ProgramText& text, std::size_t begin, std::size_t end) {
  std::vector<std::string> found;
  for (std::size_t at = begin; at < end;) {
    const std::string name = location_name(text, at, end);
    if (!name.empty()) found.push_back(name);
    at = name.empty() ? at + 1 : at + name.size();
  }
  return found;
}

std::size_t end_of_argument(std::string_view code, std::size_t begin, std::size_t end) {
  int depth = 0;
  for (std::size_t at = begin; at < end; ++at) {
    if (code[at] == ',' && depth == 0) return at;
    depth += code[at] == '(' || code[at] == '[' ? 1 : code[at] == ')' || code[at] == ']' ? -1 : 0;
  }
  return end;
}

}  // namespace demecal::inline languages
