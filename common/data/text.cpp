#include "data/text.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <limits>
#include <system_error>
#include <utility>
#include <vector>

namespace demecal::inline data {

std::optional<double> parse_number(std::string_view text) {
  if (text.size() > 1 && text.front() == '+' && text[1] != '-') text.remove_prefix(1);
  double value = 0.0;
  const auto [end, fault] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (fault != std::errc{} || end != text.data() + text.size() || !std::isfinite(value)) return std::nullopt;
  return value;
}

namespace {

/// Whether digits stand in threes behind the first, with a separator between: "3,070.733", "3'070.733", "3 070".
bool has_thousands_apart(std::string_view text, char decimal) {
  if (!text.empty() && (text.front() == '+' || text.front() == '-')) text.remove_prefix(1);
  text = text.substr(0, text.find(decimal));
  const std::size_t first = text.find_first_of(",.' ");
  if (first == std::string_view::npos || first == 0 || first > 3) return false;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const bool separates = i >= first && (i - first) % 4 == 0;
    if (separates ? text[i] != text[first] : text[i] < '0' || text[i] > '9') return false;
  }
  return (text.size() - first) % 4 == 0;
}

/// What tables write where there is no value.
bool says_nothing(std::string_view lower) {
  constexpr std::array<std::string_view, 7> kNothing{"na", "n/a", "#n/a", "null", "none", "missing", "?"};
  return lower.find_first_not_of("-") == std::string_view::npos || std::ranges::find(kNothing, lower) != kNothing.end();
}

}  // namespace

std::string why_no_number(const std::string& text, char decimal) {
  if (text.empty()) return "is empty where a number is expected";
  if (decimal == ',' && text.find('.') != std::string::npos &&
      text.find_first_not_of("+-.,' 0123456789eE") == std::string::npos)
    return "has a point where the file writes decimal commas: is it a separator of thousands?";
  if (has_thousands_apart(text, decimal))
    return "looks like a number with separators of thousands: export the table without them";
  const std::string lower = lower_case(text);
  if (says_nothing(lower)) return "is not a number: where nothing was measured leave the row out";
  if (lower.find("nan") != std::string::npos || lower.find("inf") != std::string::npos)
    return "must be a finite number: where nothing was measured leave the row out";
  if (text.starts_with("\u2212")) return "is not a number: it begins with a dash in place of a minus sign";
  const std::size_t unit = text.find_first_not_of("+-.,0123456789eE ");
  if (unit != 0 && unit != std::string::npos && text.find_first_of("0123456789", unit) == std::string::npos)
    return "is not a number: write its unit in the heading alone";
  return "is not a number";
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

std::string joined_words(std::span<const std::string> words, std::string_view between) {
  std::string text;
  for (const std::string& word : words) {
    if (!text.empty()) text += between;
    text += word;
  }
  return text;
}

std::string listed_words(std::span<const std::string> words, std::string_view last) {
  if (words.size() < 2) return joined_words(words, "");
  return joined_words(words.first(words.size() - 1), ", ") + ' ' + std::string(last) + ' ' + words.back();
}

std::string counted(std::size_t count, std::string_view noun) {
  return std::to_string(count) + ' ' + std::string(noun) + (count == 1 ? "" : "s");
}

std::size_t edit_distance(std::string_view from, std::string_view to) {
  // Row i holds the distances of the first i letters of `from` to every beginning of `to`.
  std::vector<std::size_t> before_last(to.size() + 1), last(to.size() + 1), row(to.size() + 1);
  for (std::size_t j = 0; j <= to.size(); ++j) row[j] = j;
  for (std::size_t i = 1; i <= from.size(); ++i) {
    before_last = std::exchange(last, row);
    row[0] = i;
    for (std::size_t j = 1; j <= to.size(); ++j) {
      const std::size_t replaced = last[j - 1] + (from[i - 1] == to[j - 1] ? 0 : 1);
      row[j] = std::min({replaced, last[j] + 1, row[j - 1] + 1});
      const bool swapped = i > 1 && j > 1 && from[i - 1] == to[j - 2] && from[i - 2] == to[j - 1];
      if (swapped) row[j] = std::min(row[j], before_last[j - 2] + 1);
    }
  }
  return row[to.size()];
}

namespace {

/// Whether a name is the other with words before or behind it: alpha_deg and alpha, standard_dh and dh.
bool adds_words(std::string_view longer, std::string_view shorter) {
  if (shorter.empty() || longer.size() <= shorter.size()) return false;
  const std::size_t more = longer.size() - shorter.size();
  return (longer.starts_with(shorter) && longer[shorter.size()] == '_') ||
         (longer.ends_with(shorter) && longer[more - 1] == '_');
}

}  // namespace

std::string nearest_name(std::string_view word, std::span<const std::string> names) {
  std::string nearest;
  std::pair smallest{true, std::numeric_limits<std::size_t>::max()};
  const std::string sought = lower_case(word);
  for (const std::string& name : names) {
    const std::string known = lower_case(name);
    const bool by_letters = !adds_words(known, sought) && !adds_words(sought, known);
    const std::size_t distance = edit_distance(sought, known);
    // A slip of one letter is likelier than words left out.
    const std::pair far{by_letters && distance > 1, distance};
    if (far >= smallest) continue;
    smallest = far;
    nearest = name;
  }
  return nearest;
}

}  // namespace demecal::inline data
