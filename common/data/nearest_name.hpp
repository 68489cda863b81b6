// The name a user may have meant.
#pragma once

#include <span>
#include <string>
#include <string_view>

namespace demecal {

/// The fewest letters to insert, delete, replace or swap with a neighbour that turn one word into the other.
std::size_t edit_distance(std::string_view from, std::string_view to);

/// The name with the smallest edit distance to `word`, letter case ignored; the first of equals. Empty where there are
/// no names.
std::string nearest_name(std::string_view word, std::span<const std::string> names);

}  // namespace demecal
