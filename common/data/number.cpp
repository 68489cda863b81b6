#include "data/number.hpp"

#include <array>
#include <charconv>
#include <cmath>

namespace demecal {

std::optional<double> parse_number(std::string_view text) {
  if (text.size() > 1 && text.front() == '+' && text[1] != '-') text.remove_prefix(1);
  double value = 0.0;
  const auto [end, fault] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (fault != std::errc{} || end != text.data() + text.size() || !std::isfinite(value)) return std::nullopt;
  return value;
}

std::string number_text(double value) {
  std::array<char, 32> buffer;
  const auto result = std::to_chars(buffer.data(), buffer.data() + buffer.size(), value);
  return {buffer.data(), result.ptr};
}

std::string number_text(double inside, UnitConversion to_border, UnitConversion to_inside) {
  const double border = to_border(inside);
  for (int digits = 1; digits <= 17; ++digits) {
    std::array<char, 32> buffer;
    const auto result =
        std::to_chars(buffer.data(), buffer.data() + buffer.size(), border, std::chars_format::general, digits);
    const std::string text(buffer.data(), result.ptr);
    if (const auto rounded = parse_number(text); rounded && to_inside(*rounded) == inside) return number_text(*rounded);
  }
  return number_text(border);
}

}  // namespace demecal
