// Numbers and names as text: read strictly, written with as many digits as they need, compared as people mean them.
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <string_view>

namespace demecal::inline data {

/// The finite number that the whole of `text` writes in decimal notation, a leading + allowed. Nothing where it writes
/// no number, one out of range, NaN or an infinity.
std::optional<double> parse_number(std::string_view text);

/// Why a field of a table that writes `decimal` before its fractions holds no number, and what to do: "is empty where a
/// number is expected".
std::string why_no_number(const std::string& text, char decimal);

/// The shortest text that parses back to the same bits.
std::string number_text(double value);

/// A change of unit, such as radians() or metres().
using UnitConversion = double (*)(double);

/// The shortest decimal of `inside` in the border's unit that `to_inside` turns back into the same bits; where no
/// decimal does, the one that comes within the last bit.
std::string number_text(double inside, UnitConversion to_border, UnitConversion to_inside);

/// Without the difference between capital and small ASCII letters, whatever the locale.
inline std::string lower_case(std::string_view text) {
  std::string lower(text);
  for (char& letter : lower) {
    if (letter >= 'A' && letter <= 'Z') letter = static_cast<char>(letter - 'A' + 'a');
  }
  return lower;
}

/// The words one after another, `between` between each two.
std::string joined_words(std::span<const std::string> words, std::string_view between);
/// "a, b or c", where `last` is "or".
std::string listed_words(std::span<const std::string> words, std::string_view last);

/// "1 pose", "2 poses".
std::string counted(std::size_t count, std::string_view noun);

/// The fewest letters to insert, delete, replace or swap with a neighbour that turn one word into the other.
std::size_t edit_distance(std::string_view from, std::string_view to);

/// The name with the smallest edit distance to `word`, letter case ignored; the first of equals. Empty where there are
/// no names.
std::string nearest_name(std::string_view word, std::span<const std::string> names);

}  // namespace demecal::inline data
