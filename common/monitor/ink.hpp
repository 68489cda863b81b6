// Colours of terminal text, or none.
#pragma once

#include <string>

namespace demecal {

enum class Ink { plain, strong, faint, good, bad, bar };

/// `text` between the escape codes of an ink, or as it stands where `colours` is false.
inline std::string painted(const std::string& text, Ink ink, bool colours) {
  constexpr const char* kCodes[] = {"", "\033[1m", "\033[2m", "\033[32m", "\033[31m", "\033[36m"};
  if (!colours || ink == Ink::plain || text.empty()) return text;
  return kCodes[static_cast<std::size_t>(ink)] + text + "\033[0m";
}

}  // namespace demecal
