#include "terminal/text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <sstream>
#include <utility>

namespace demecal::inline terminal {
namespace {

bool begins_letter(char byte) {
  return (static_cast<unsigned char>(byte) & 0xC0U) != 0x80U;
}

std::string blanks_beside(const std::string& text, std::size_t columns) {
  const std::size_t taken = display_width(text);
  return std::string(columns > taken ? columns - taken : 0, ' ');
}

std::string repeated(const char* letter, std::size_t times) {
  std::string text;
  for (std::size_t i = 0; i < times; ++i) text += letter;
  return text;
}

}  // namespace

std::size_t display_width(const std::string& text) {
  return static_cast<std::size_t>(std::ranges::count_if(text, begins_letter));
}

std::string truncated(std::string text, std::size_t columns) {
  if (display_width(text) <= columns) return text;
  while (display_width(text) > columns - 3) {
    while (!begins_letter(text.back())) text.pop_back();
    text.pop_back();
  }
  return text + "...";
}

std::string left_aligned(const std::string& text, std::size_t columns) {
  const std::string shown = truncated(text, columns);
  return shown + blanks_beside(shown, columns);
}

std::string right_aligned(const std::string& text, std::size_t columns) {
  const std::string shown = truncated(text, columns);
  return blanks_beside(shown, columns) + shown;
}

std::string wrapped(const std::string& first, const std::string& text, std::size_t indent) {
  std::string all, line = first;
  std::istringstream words(text);
  for (std::string word; words >> word;) {
    word = truncated(word, kTerminalColumns - indent - 1);
    if (display_width(line) + 1 + display_width(word) > kTerminalColumns) {
      all += std::exchange(line, std::string(indent - 1, ' ')) + "\n";
    }
    line += " " + word;
  }
  return all + line + "\n";
}

std::vector<std::string> wrapped_lines(const std::string& text, std::size_t columns, std::size_t indent) {
  std::vector<std::string> lines;
  std::string line;
  bool is_begun = false;
  const auto begin_next = [&] {
    lines.push_back(std::exchange(line, std::string(indent, ' ')));
    is_begun = false;
  };
  std::istringstream words(text);
  for (std::string word; words >> word;) {
    if (is_begun && display_width(line) + 1 + display_width(word) > columns) begin_next();
    if (is_begun) line += ' ';
    is_begun = true;
    for (const char byte : word) {
      if (begins_letter(byte) && display_width(line) == columns) begin_next();
      line += byte;
      is_begun = true;
    }
  }
  if (is_begun) lines.push_back(line);
  return lines;
}

std::string short_real(double value) {
  constexpr std::size_t kMost = 7;
  if (std::isnan(value)) return "–";
  for (int digits = 5; digits > 2; --digits) {
    std::string text = fmt::format("{:#.{}g}", value, digits);
    if (text.back() == '.') text.pop_back();
    if (text.size() <= kMost) return text;
  }
  const std::string text = fmt::format("{:.2g}", value);
  return text.size() <= kMost ? text : fmt::format("{:.0e}", value);
}

std::string short_count(double value) {
  if (!(value >= 0.0) || std::isinf(value)) return "–";
  if (value < 999.5) return fmt::format("{:.0f}", value);
  constexpr const char* kSuffixes[] = {"k", "M", "G", "T"};
  for (const char* const suffix : kSuffixes) {
    value /= 1e3;
    if (value < 9.995) return fmt::format("{:.2f}{}", value, suffix);
    if (value < 99.95) return fmt::format("{:.1f}{}", value, suffix);
    if (value < 999.5) return fmt::format("{:.0f}{}", value, suffix);
  }
  return "many";
}

std::string percent(double share) {
  return std::isfinite(share) ? fmt::format("{:.0f}%", 100.0 * std::clamp(share, 0.0, 1.0)) : "–";
}

std::string short_time(double time_s) {
  if (!std::isfinite(time_s)) return "–";
  const auto s = static_cast<std::int64_t>(std::clamp(time_s, 0.0, 1e9) + 0.5);
  if (s < 60) return fmt::format("{} s", s);
  if (s < 3600) return fmt::format("{} min {} s", s / 60, s % 60);
  return fmt::format("{} h {} min", s / 3600, s % 3600 / 60);
}

BarParts bar_parts(double share, std::size_t columns) {
  const double full = std::isfinite(share) ? std::clamp(share, 0.0, 1.0) * static_cast<double>(columns) : 0.0;
  const auto letters = static_cast<std::size_t>(full + 0.5);
  return {repeated("━", letters), repeated("─", columns - letters)};
}

}  // namespace demecal::inline terminal
