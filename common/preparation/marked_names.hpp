// Readings whose rows begin with names of precision points: their # is no comment.
#pragma once

#include <string>

namespace demecal {

/// The text of a table with the names in quotes where every row begins with one, as in "#cp[3],1,2,3"; the text itself
/// where none does. Throws InputError where some rows do: they may be readings, or rows that were taken out.
std::string with_marked_names(const std::string& text, const std::string& file);

}  // namespace demecal
