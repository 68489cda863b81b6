#include "report/terminal_text.hpp"

#include <algorithm>
#include <sstream>
#include <utility>

namespace demecal {
namespace {

bool begins_letter(char byte) {
  return (static_cast<unsigned char>(byte) & 0xC0U) != 0x80U;
}

std::string blanks_beside(const std::string& text, std::size_t columns) {
  const std::size_t taken = columns_of(text);
  return std::string(columns > taken ? columns - taken : 0, ' ');
}

}  // namespace

std::size_t columns_of(const std::string& text) {
  return static_cast<std::size_t>(std::ranges::count_if(text, begins_letter));
}

std::string cut(std::string text, std::size_t columns) {
  if (columns_of(text) <= columns) return text;
  while (columns_of(text) > columns - 3) {
    while (!begins_letter(text.back())) text.pop_back();
    text.pop_back();
  }
  return text + "...";
}

std::string left(const std::string& text, std::size_t columns) {
  const std::string shown = cut(text, columns);
  return shown + blanks_beside(shown, columns);
}

std::string right(const std::string& text, std::size_t columns) {
  const std::string shown = cut(text, columns);
  return blanks_beside(shown, columns) + shown;
}

std::string wrapped(const std::string& first, const std::string& text, std::size_t indent) {
  std::string all, line = first;
  std::istringstream words(text);
  for (std::string word; words >> word;) {
    word = cut(word, kTerminalColumns - indent - 1);
    if (columns_of(line) + 1 + columns_of(word) > kTerminalColumns) {
      all += std::exchange(line, std::string(indent - 1, ' ')) + "\n";
    }
    line += " " + word;
  }
  return all + line + "\n";
}

}  // namespace demecal
