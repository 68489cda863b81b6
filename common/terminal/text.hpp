// Text that fits a terminal, whatever words it is given: columns, colours, and figures in few letters.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace demecal::inline terminal {

inline constexpr std::size_t kTerminalColumns = 100;

/// How many letters of UTF-8 text stand side by side.
std::size_t display_width(const std::string& text);

/// `text` with an ellipsis for what does not fit.
std::string truncated(std::string text, std::size_t columns);

/// `text` cut to `columns` and filled up with blanks after it; or before it.
std::string left_aligned(const std::string& text, std::size_t columns);
std::string right_aligned(const std::string& text, std::size_t columns);

/// `first` and the words of `text` after it, in lines of at most kTerminalColumns that begin with `indent` (at least
/// 1) blanks but for the first.
std::string wrapped(const std::string& first, const std::string& text, std::size_t indent);

/// The words of `text` in lines of at most `columns`, without ends, that begin with `indent` blanks but for the first.
/// Words that are longer than a line are cut into several.
std::vector<std::string> wrapped_lines(const std::string& text, std::size_t columns, std::size_t indent);

/// Colours of terminal text, or none.
enum class TextStyle { plain, strong, faint, good, bad, bar };

/// `text` between the escape codes of an ink, or as it stands where `colours` is false.
inline std::string styled(const std::string& text, TextStyle ink, bool colours) {
  constexpr const char* kCodes[] = {"", "\033[1m", "\033[2m", "\033[32m", "\033[31m", "\033[36m"};
  if (!colours || ink == TextStyle::plain || text.empty()) return text;
  return kCodes[static_cast<std::size_t>(ink)] + text + "\033[0m";
}

/// At most 7 letters with 2 digits or more: "0.01234", "1.2e-05", "inf"; a dash for what is not a number.
std::string short_real(double value);
/// At most 5 letters: "812", "12.3k", "4.56M".
std::string short_count(double value);
/// "87%"; a share of 0 to 1.
std::string percent(double share);
/// "8 s", "3 min 20 s", "2 h 5 min".
std::string short_time(double time_s);
/// A bar of `columns` letters, of which the share is full: "━━━" and "───".
struct BarParts {
  std::string full, empty;
};
BarParts bar_parts(double share, std::size_t columns);

}  // namespace demecal::inline terminal
