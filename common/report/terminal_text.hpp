// Text that fits a terminal: at most 100 columns, whatever words it is given.
#pragma once

#include <cstddef>
#include <string>

namespace demecal {

inline constexpr std::size_t kTerminalColumns = 100;

/// How many letters of UTF-8 text stand side by side.
std::size_t columns_of(const std::string& text);

/// `text` with an ellipsis for what does not fit.
std::string cut(std::string text, std::size_t columns);

/// `text` cut to `columns` and filled up with blanks after it; or before it.
std::string left(const std::string& text, std::size_t columns);
std::string right(const std::string& text, std::size_t columns);

/// `first` and the words of `text` after it, in lines of at most kTerminalColumns that begin with `indent` (at least
/// 1) blanks but for the first.
std::string wrapped(const std::string& first, const std::string& text, std::size_t indent);

}  // namespace demecal
