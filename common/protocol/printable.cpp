#include "protocol/printable.hpp"

#include <array>
#include <cstdint>

namespace demecal {
namespace {

/// A character of UTF-8: how many bytes it takes, and its number; 0 bytes where there is none.
struct Character {
  std::size_t bytes = 0;
  std::uint32_t number = 0;
};

std::uint32_t bits(char byte) {
  return static_cast<std::uint8_t>(byte);
}

/// RFC 3629: no overlong forms, no surrogates, nothing above 10FFFF.
Character first_character(std::string_view text) {
  struct Form {
    std::uint32_t mask, lead, smallest;
  };
  constexpr std::array<Form, 4> kForms{
      {{0x80, 0x00, 0}, {0xE0, 0xC0, 0x80}, {0xF0, 0xE0, 0x800}, {0xF8, 0xF0, 0x10000}}};
  for (std::size_t bytes = 1; bytes <= kForms.size() && bytes <= text.size(); ++bytes) {
    const Form& form = kForms[bytes - 1];
    if ((bits(text[0]) & form.mask) != form.lead) continue;
    std::uint32_t number = bits(text[0]) & ~form.mask & 0xFF;
    for (std::size_t i = 1; i < bytes; ++i) {
      if ((bits(text[i]) & 0xC0) != 0x80) return {};
      number = (number << 6) | (bits(text[i]) & 0x3F);
    }
    const bool is_surrogate = number >= 0xD800 && number <= 0xDFFF;
    if (number < form.smallest || number > 0x10FFFF || is_surrogate) return {};
    return {bytes, number};
  }
  return {};
}

bool is_shown(std::uint32_t number) {
  const bool is_control = number < 0x20 || (number >= 0x7F && number < 0xA0);
  const bool separates = number == 0x2028 || number == 0x2029;
  const bool turns = number == 0x200E || number == 0x200F || (number >= 0x202A && number <= 0x202E) ||
                     (number >= 0x2066 && number <= 0x2069);
  return !is_control && !separates && !turns;
}

}  // namespace

std::string printable(std::string_view text) {
  std::string shown;
  while (!text.empty()) {
    const Character character = first_character(text);
    const std::size_t bytes = character.bytes == 0 ? 1 : character.bytes;
    if (character.bytes != 0 && is_shown(character.number)) {
      shown += text.substr(0, bytes);
    } else {
      shown += '?';
    }
    text.remove_prefix(bytes);
  }
  return shown;
}

bool is_printable(std::string_view text) {
  return printable(text) == text;
}

}  // namespace demecal
