#include "tables/heading.hpp"

#include <cstddef>
#include <utility>

#include "data/columns.hpp"
#include "tables/layout.hpp"

namespace demecal::inline tables {
namespace {

bool is_unit(std::string_view text) {
  return find_heading_unit(trimmed(text)).has_value();
}

}  // namespace

Heading split_heading(std::string_view text) {
  const std::string_view whole = trimmed(text);
  const auto split = [&](std::size_t at, std::string_view unit) {
    return Heading{std::string(trimmed(whole.substr(0, at))), std::string(trimmed(unit))};
  };
  for (const auto& [open, close] : {std::pair{'[', ']'}, std::pair{'(', ')'}}) {
    const std::size_t at = whole.rfind(open);
    if (!whole.ends_with(close) || at == std::string_view::npos || at == 0) continue;
    const std::string_view unit = whole.substr(at + 1, whole.size() - at - 2);
    if (open == '[' ? !trimmed(unit).empty() : is_unit(unit)) return split(at, unit);
  }
  for (const char mark : {'/', ','}) {
    const std::size_t at = whole.rfind(mark);
    if (at == std::string_view::npos || at == 0 || !is_unit(whole.substr(at + 1))) continue;
    return split(at, whole.substr(at + 1));
  }
  return {std::string(whole), ""};
}

std::string lone_unit(std::string_view field) {
  std::string_view text = trimmed(field);
  const bool square = text.starts_with('[') && text.ends_with(']');
  const bool round = text.starts_with('(') && text.ends_with(')');
  if (text.size() > 2 && (square || round)) text = trimmed(text.substr(1, text.size() - 2));
  return square || is_unit(text) ? std::string(text) : "";
}

}  // namespace demecal::inline tables
