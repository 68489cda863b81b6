#include "programs/cell.hpp"

#include <algorithm>
#include <array>
#include <charconv>

#include "data/number.hpp"

namespace demecal {
namespace {

constexpr int kMostDecimals = 15;

/// Digits behind the point of a number as written, its exponent taken in.
int decimals_of(std::string_view number) {
  const std::size_t mark = std::min(number.find_first_of("eE"), number.size());
  const std::size_t point = number.substr(0, mark).find('.');
  int decimals = point == std::string_view::npos ? 0 : static_cast<int>(mark - point - 1);
  if (mark < number.size()) {
    const double exponent = parse_number(number.substr(mark + 1)).value_or(0.0);
    decimals -= static_cast<int>(std::clamp(exponent, -400.0, 400.0));
  }
  return std::clamp(decimals, 0, kMostDecimals);
}

}  // namespace

std::optional<Cell> cell_at(std::string_view text, std::size_t begin, std::size_t size, const CellUnit& unit) {
  const std::string_view number = text.substr(begin, size);
  const std::optional<double> value = parse_number(number);
  if (!value) return std::nullopt;
  return Cell{begin, size, *value, unit.size, std::max(decimals_of(number), unit.least_decimals)};
}

std::optional<std::string> rewritten(const Cell& cell, double inside) {
  std::array<char, 400> buffer;  // the largest number has 309 digits before its point
  const auto written = std::to_chars(buffer.data(), buffer.data() + buffer.size(), inside / cell.unit,
                                     std::chars_format::fixed, cell.decimals);
  std::string text(buffer.data(), written.ptr);
  const std::optional<double> value = parse_number(text);
  if (!value || *value == cell.value) return std::nullopt;
  if (*value == 0.0 && text.front() == '-') text.erase(0, 1);
  return text;
}

}  // namespace demecal
