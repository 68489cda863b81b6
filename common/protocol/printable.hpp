// Text from elsewhere, made fit to be shown: it may not move a terminal's cursor, nor pass for another line.
#pragma once

#include <string>
#include <string_view>

namespace demecal {

/// `text` with a question mark for every control character, every character that turns the direction of writing, and
/// every byte that is not UTF-8.
std::string printable(std::string_view text);
bool is_printable(std::string_view text);

}  // namespace demecal
