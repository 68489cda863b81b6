#include "yaml/yaml_text.hpp"

#include <algorithm>
#include <array>
#include <vector>

#include "data/text.hpp"
#include "kinematics/units.hpp"

namespace demecal::inline yaml {
namespace {

bool is_key_letter(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_';
}

/// Words that YAML readers take for a truth value or nothing.
bool is_reserved(std::string_view text) {
  constexpr std::array<std::string_view, 10> kWords{"true", "false", "null", "yes", "no", "on", "off", "y", "n", "nan"};
  return std::find(kWords.begin(), kWords.end(), lower_case(text)) != kWords.end();
}

bool needs_no_quotes(std::string_view text) {
  if (text.empty() || !is_key_letter(text.front()) || text.back() == ' ' || is_reserved(text)) return false;
  return std::all_of(text.begin(), text.end(), [](char c) {
    return is_key_letter(c) || (c >= '0' && c <= '9') || c == ' ' || c == '.' || c == '/' || c == '-';
  });
}

std::string escaped_character(char c) {
  constexpr std::string_view kDigits = "0123456789abcdef";
  const auto code = static_cast<unsigned char>(c);
  if (c == '"' || c == '\\') return std::string("\\") + c;
  if (code >= 0x20 && code != 0x7f) return std::string(1, c);
  return std::string("\\x") + kDigits[code >> 4] + kDigits[code & 15];
}

}  // namespace

std::string yaml_text(std::string_view text) {
  if (needs_no_quotes(text)) return std::string(text);
  std::string quoted = "\"";
  for (const char c : text) quoted += escaped_character(c);
  return quoted + "\"";
}

std::string yaml_comment(std::string_view text) {
  std::string line = "# ";
  for (const char c : text) line += static_cast<unsigned char>(c) < 0x20 ? ' ' : c;
  return line + "\n";
}

std::string yaml_list(std::span<const std::string> scalars) {
  std::string text = "[";
  for (const std::string& scalar : scalars) text += (text.size() > 1 ? ", " : "") + scalar;
  return text + "]";
}

std::string yaml_numbers(std::span<const double> values) {
  std::vector<std::string> texts;
  for (const double value : values) texts.push_back(number_text(value));
  return yaml_list(texts);
}

std::string yaml_mm(const Eigen::Vector3d& lengths_m) {
  std::vector<std::string> texts;
  for (const double length_m : lengths_m) texts.push_back(millimetres_text(length_m));
  return yaml_list(texts);
}

std::string degrees_text(double angle_rad) {
  return number_text(angle_rad, degrees, radians);
}
std::string millimetres_text(double length_m) {
  return number_text(length_m, millimetres, metres);
}

}  // namespace demecal::inline yaml
