// Reading a terminal's text back: its lines, and how wide they are.
#pragma once

#include <sstream>
#include <string>
#include <vector>

namespace demecal {

inline std::vector<std::string> screen_lines(const std::string& text) {
  std::vector<std::string> lines;
  std::istringstream stream(text);
  for (std::string line; std::getline(stream, line);) lines.push_back(line);
  return lines;
}

inline std::size_t letters_of(const std::string& line) {
  std::size_t letters = 0;
  for (const char byte : line) letters += (static_cast<unsigned char>(byte) & 0xC0U) != 0x80U ? 1u : 0u;
  return letters;
}

}  // namespace demecal
