// The records of MCAP: an opcode, a length of eight bytes, and fields, little endian.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <type_traits>

namespace demecal::inline recording {

inline constexpr std::string_view kMcapMagic{"\x89MCAP0\r\n", 8};

enum class McapRecord : std::uint8_t {
  header = 1,
  footer,
  schema,
  channel,
  message,
  chunk,
  message_index,
  chunk_index,
  attachment,
  statistics = 11,
  metadata,
  summary_offset = 14,
  data_end
};

/// Appends to `bytes` a number of `Number`'s size.
template <class Number>
void put(std::string& bytes, std::type_identity_t<Number> number) {
  for (std::size_t i = 0; i < sizeof(Number); ++i) {
    bytes += static_cast<char>(static_cast<std::uint64_t>(number) >> (8 * i) & 0xFFU);
  }
}
/// A text or any bytes behind their length in four bytes.
inline void put_text(std::string& bytes, std::string_view text) {
  put<std::uint32_t>(bytes, static_cast<std::uint32_t>(text.size()));
  bytes += text;
}

inline std::string mcap_record(McapRecord opcode, std::string_view content) {
  std::string bytes;
  put<std::uint8_t>(bytes, static_cast<std::uint8_t>(opcode));
  put<std::uint64_t>(bytes, content.size());
  return bytes += content;
}

/// Takes fields off the front of bytes; `is_whole` turns false where there are fewer than are asked for.
struct McapFields {
  std::string_view bytes;
  bool is_whole = true;

  std::string_view take(std::uint64_t count) {
    if (count > bytes.size()) is_whole = false;
    const std::string_view taken = is_whole ? bytes.substr(0, static_cast<std::size_t>(count)) : std::string_view();
    bytes.remove_prefix(taken.size());
    return taken;
  }
  template <class Number>
  Number number() {
    Number value = 0;
    const std::string_view taken = take(sizeof(Number));
    for (std::size_t i = taken.size(); i-- > 0;) {
      value = static_cast<Number>(static_cast<std::uint64_t>(value) << 8U | static_cast<unsigned char>(taken[i]));
    }
    return value;
  }
  std::string_view text() { return take(number<std::uint32_t>()); }
};

}  // namespace demecal::inline recording
