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

/// Wrapped lines as one, without their margins.
inline std::string unwrapped(const std::string& text) {
  std::string all;
  for (const std::string& line : screen_lines(text)) {
    const std::size_t begin = line.find_first_not_of(' ');
    if (begin != std::string::npos) all += (all.empty() ? "" : " ") + line.substr(begin);
  }
  return all;
}

inline std::size_t letters_of(const std::string& line) {
  std::size_t letters = 0;
  for (const char byte : line) letters += (static_cast<unsigned char>(byte) & 0xC0U) != 0x80U ? 1u : 0u;
  return letters;
}

}  // namespace demecal
