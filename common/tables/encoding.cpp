#include "tables/read_table.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <utility>

#include "errors/input_error.hpp"

namespace demecal::inline tables {
namespace {

struct KnownBeginning {
  std::string_view bytes;
  std::string_view is;
};
/// Files that people name where a text is meant.
constexpr std::array<KnownBeginning, 4> kNoText{{
    {"PK\x03\x04", "a spreadsheet or ZIP archive; save it as CSV or text"},
    {"\xD0\xCF\x11\xE0", "a spreadsheet in Excel's old format; save it as CSV or text"},
    {"%PDF", "a PDF; export the points as CSV or text"},
    {"\x1F\x8B", "compressed by gzip; unpack it first"},
}};

void append_utf8(std::uint32_t code, std::string& text) {
  const auto byte = [&](std::uint32_t value) { text += static_cast<char>(value); };
  if (code < 0x80) {
    byte(code);
  } else if (code < 0x800) {
    byte(0xC0 | (code >> 6));
    byte(0x80 | (code & 0x3F));
  } else if (code < 0x10000) {
    byte(0xE0 | (code >> 12));
    byte(0x80 | ((code >> 6) & 0x3F));
    byte(0x80 | (code & 0x3F));
  } else {
    byte(0xF0 | (code >> 18));
    byte(0x80 | ((code >> 12) & 0x3F));
    byte(0x80 | ((code >> 6) & 0x3F));
    byte(0x80 | (code & 0x3F));
  }
}

/// The bytes of the UTF-8 sequence that begins there; 0 where none does.
std::size_t sequence_length(std::string_view rest) {
  const auto first = static_cast<unsigned char>(rest.front());
  const std::size_t length = first < 0x80            ? 1
                             : first >> 5 == 0b110   ? 2
                             : first >> 4 == 0b1110  ? 3
                             : first >> 3 == 0b11110 ? 4
                                                     : 0;
  if (length == 0 || length > rest.size()) return 0;
  const auto continues = [](char c) { return (static_cast<unsigned char>(c) & 0xC0) == 0x80; };
  return std::ranges::all_of(rest.substr(1, length - 1), continues) ? length : 0;
}

bool is_utf8(std::string_view bytes) {
  while (!bytes.empty()) {
    const std::size_t length = sequence_length(bytes);
    if (length == 0) return false;
    bytes.remove_prefix(length);
  }
  return true;
}

std::string from_latin1(std::string_view bytes) {
  std::string text;
  for (const char c : bytes) append_utf8(static_cast<unsigned char>(c), text);
  return text;
}

enum class ByteOrder { little, big };

std::string from_utf16(std::string_view bytes, ByteOrder order, const std::string& file) {
  std::string text;
  std::size_t line = 1;
  const auto unit_at = [&](std::size_t at) {
    const auto first = static_cast<unsigned char>(bytes[at]), second = static_cast<unsigned char>(bytes[at + 1]);
    return static_cast<std::uint32_t>(order == ByteOrder::little ? second << 8 | first : first << 8 | second);
  };
  for (std::size_t at = 0; at + 1 < bytes.size(); at += 2) {
    std::uint32_t code = unit_at(at);
    if (code == '\n') ++line;
    if (code >= 0xD800 && code < 0xE000) {
      const std::uint32_t low = at + 3 < bytes.size() ? unit_at(at + 2) : 0;
      if (code >= 0xDC00 || low < 0xDC00 || low >= 0xE000)
        throw InputError({file, line}, "", "has half a character of UTF-16; export the file again, as UTF-8");
      code = 0x10000 + ((code - 0xD800) << 10) + (low - 0xDC00);
      at += 2;
    }
    append_utf8(code, text);
  }
  if (bytes.size() % 2 != 0)
    throw InputError({file, line}, "", "ends within a character of UTF-16: the file is cut off; export it again");
  return text;
}

/// Text in letters of the West is every second byte zero.
bool looks_like_utf16(std::string_view bytes, std::size_t zero_at) {
  const std::size_t pairs = std::min<std::size_t>(bytes.size() / 2, 512);
  std::size_t zeros = 0;
  for (std::size_t i = 0; i < pairs; ++i) zeros += bytes[2 * i + zero_at] == '\0' ? 1 : 0;
  return pairs > 0 && zeros * 10 >= pairs * 7;
}

void refuse_zero_bytes(std::string_view bytes, const std::string& file) {
  const std::size_t zero = bytes.find('\0');
  if (zero == std::string_view::npos) return;
  const auto line = static_cast<std::size_t>(std::ranges::count(bytes.substr(0, zero), '\n')) + 1;
  throw InputError({file, line}, "", "holds a zero byte, which no text has: is the file a text?");
}

}  // namespace

DecodedText decode_text(std::string_view bytes, const std::string& file) {
  for (const KnownBeginning& known : kNoText) {
    if (bytes.starts_with(known.bytes)) throw InputError({file, 1}, "", "is no text, but " + std::string(known.is));
  }
  if (bytes.starts_with("\xFF\xFE")) return {from_utf16(bytes.substr(2), ByteOrder::little, file), "UTF-16"};
  if (bytes.starts_with("\xFE\xFF")) return {from_utf16(bytes.substr(2), ByteOrder::big, file), "UTF-16"};
  if (looks_like_utf16(bytes, 1)) return {from_utf16(bytes, ByteOrder::little, file), "UTF-16"};
  if (looks_like_utf16(bytes, 0)) return {from_utf16(bytes, ByteOrder::big, file), "UTF-16"};
  refuse_zero_bytes(bytes, file);
  if (bytes.starts_with("\xEF\xBB\xBF")) bytes.remove_prefix(3);
  if (!is_utf8(bytes)) return {from_latin1(bytes), "Latin-1"};
  return {std::string(bytes), ""};
}

}  // namespace demecal::inline tables
