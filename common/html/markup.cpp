#include "html/markup.hpp"

#include <fmt/format.h>

#include <algorithm>
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

/// How many bytes the letter at the beginning of `text` has; 0 where they are no UTF-8.
std::size_t bytes_of_letter(std::string_view text) {
  const auto byte = [&](std::size_t i) { return i < text.size() ? static_cast<unsigned char>(text[i]) : 0U; };
  const unsigned lead = byte(0);
  if (lead < 0x80U) return 1;
  if (lead < 0xC2U || lead > 0xF4U) return 0;
  const std::size_t length = lead < 0xE0U ? 2 : lead < 0xF0U ? 3 : 4;
  for (std::size_t i = 1; i < length; ++i) {
    if ((byte(i) & 0xC0U) != 0x80U) return 0;
  }
  // Neither longer forms than a letter needs, nor halves of pairs, nor letters beyond the last.
  const unsigned least = lead == 0xE0U ? 0xA0U : lead == 0xF0U ? 0x90U : 0x80U;
  const unsigned most = lead == 0xEDU ? 0x9FU : lead == 0xF4U ? 0x8FU : 0xBFU;
  return byte(1) < least || byte(1) > most ? 0 : length;
}

/// Without the sign of a zero that rounding left.
std::string without_negative_zero(const std::string& number) {
  const bool zero = number.find_first_of("123456789") == std::string::npos;
  return zero && number.starts_with('-') ? number.substr(1) : number;
}

}  // namespace

std::string escaped(std::string_view text) {
  std::string markup;
  while (!text.empty()) {
    const std::size_t bytes = bytes_of_letter(text);
    markup += bytes == 0   ? std::string(kReplacement)
              : bytes == 1 ? escaped_letter(text[0])
                           : std::string(text.substr(0, bytes));
    text.remove_prefix(std::max<std::size_t>(bytes, 1));
  }
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

std::string table_panel(const std::string& id, const std::string& head_cells, const std::string& rows,
                        std::size_t row_count) {
  constexpr std::size_t kMostAtOnce = 16;
  return fmt::format(
      "<div class=\"panel{}\"><table id=\"{}\">\n<thead><tr>{}</tr></thead>\n<tbody>\n{}</tbody></table></div>\n",
      row_count > kMostAtOnce ? " long" : "", id, head_cells, rows);
}

}  // namespace demecal
