// The messages of an MCAP file, such as McapWriter makes: of chunks that are not compressed, in the order of the file.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace demecal::inline recording {

struct McapMessage {
  std::string topic;
  std::uint64_t time_ns = 0;
  std::string data;
};

/// Whether the bytes begin as such a file does.
bool is_mcap(std::string_view bytes);

/// Of a file that was not written to its end what is whole. Throws InputError naming `file` where it is none, is
/// compressed, or where a chunk's checksum contradicts it.
std::vector<McapMessage> read_mcap(std::string_view bytes, const std::string& file);

}  // namespace demecal::inline recording
