#include "report/html_text.hpp"

#include <fmt/format.h>

#include <cmath>

namespace demecal {
namespace {

constexpr std::string_view kDash = "–";
constexpr std::string_view kReplacement = "\xEF\xBF\xBD";

std::string escaped_letter(char letter) {
  switch (letter) {
    case '&':
      return "&amp;";
    case '<':
      return "&lt;";
    case '>':
      return "&gt;";
    case '"':
      return "&quot;";
    case '\'':
      return "&#39;";
    default:
      const bool control = static_cast<unsigned char>(letter) < 0x20 && letter != '\n' && letter != '\t';
      return control || letter == 0x7F ? std::string(kReplacement) : std::string(1, letter);
  }
}

/// Without the sign of a zero that rounding left.
std::string without_negative_zero(const std::string& number) {
  const bool zero = number.find_first_of("123456789") == std::string::npos;
  return zero && number.starts_with('-') ? number.substr(1) : number;
}

}  // namespace

std::string escaped(std::string_view text) {
  std::string markup;
  for (const char letter : text) markup += escaped_letter(letter);
  return markup;
}

std::string fixed(std::optional<double> value, int decimals) {
  if (!value || !std::isfinite(*value)) return std::string(kDash);
  if (std::abs(*value) >= 1e7) return fmt::format("{:.{}e}", *value, decimals);
  return without_negative_zero(fmt::format("{:.{}f}", *value, decimals));
}

std::string grouped(std::uint64_t value) {
  std::string text = std::to_string(value);
  for (std::size_t i = text.size(); i > 3; i -= 3) text.insert(i - 3, "\u202F");
  return text;
}

std::string change(std::optional<double> before, std::optional<double> after) {
  if (!before || !after || *before == 0.0) return std::string(kDash);
  const double percent = 100.0 * (*after - *before) / std::abs(*before);
  if (!std::isfinite(percent)) return std::string(kDash);
  return fmt::format("{}{}\u00A0%", percent >= 0.5 ? "+" : "", fixed(percent, 0));
}

std::string duration(double seconds) {
  if (seconds < 60.0) return fmt::format("{:.1f} s", seconds);
  const double minutes = std::floor(seconds / 60.0);
  if (minutes < 60.0) return fmt::format("{:.0f} min {:02.0f} s", minutes, std::floor(seconds - 60.0 * minutes));
  const double hours = std::floor(minutes / 60.0);
  return fmt::format("{:.0f} h {:02.0f} min", hours, minutes - 60.0 * hours);
}

std::string name_list(const std::vector<std::string>& names) {
  if (names.empty()) return {};
  std::string list = "<ul class=\"names\">";
  for (const std::string& name : names) list += "<li>" + escaped(name) + "</li>";
  return list + "</ul>\n";
}

std::string table_row(const std::string& head, const std::vector<std::string>& cells) {
  std::string row = "<tr><th scope=\"row\">" + head + "</th>";
  for (const std::string& cell : cells) row += "<td>" + cell + "</td>";
  return row + "</tr>\n";
}

std::string section(std::string_view id, std::string_view title, const std::string& body) {
  if (body.empty()) return {};
  return fmt::format("<section id=\"{}\">\n<h2>{}</h2>\n{}</section>\n", id, title, body);
}

}  // namespace demecal
