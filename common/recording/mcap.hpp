// Messages as an MCAP file (mcap.dev/spec, version 0): chunks with their indexes, statistics and checksums,
// uncompressed. Bytes are handed out as they become due; who writes them may be stopped at any time, and loses but the
// last chunk. And what is whole of such a file, in its order.
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace demecal::inline recording {

/// As in zlib and MCAP (ISO 3309); `before` is that of what stands before these bytes.
std::uint32_t crc32(std::string_view bytes, std::uint32_t before = 0);

class McapWriter {
 public:
  /// `library` says who writes.
  explicit McapWriter(const std::string& library);

  /// The number of a schema of JSON messages, in JSON Schema; and that of a channel of such messages.
  std::uint16_t add_schema(const std::string& name, const std::string& json_schema);
  std::uint16_t add_channel(std::uint16_t schema, const std::string& topic);
  void add_message(std::uint16_t channel, std::uint64_t time_ns, std::string_view json);

  /// Ends the present chunk, if there is anything in it.
  void end_chunk();
  std::size_t chunk_bytes() const { return chunk_.size(); }
  /// Ends the file; nothing may be added any more.
  void finish();

  /// What is to be written next; empty afterwards.
  std::string take_bytes();

 private:
  struct Channel {
    std::string record;
    std::uint32_t sequence = 0;
    std::uint64_t messages = 0;
  };
  struct Span {
    std::uint64_t begin_ns = 0, end_ns = 0;
    void extend(std::uint64_t time_ns, bool is_first);
  };
  struct IndexEntry {
    std::uint64_t time_ns = 0, offset = 0;
  };

  void append(const std::string& bytes);
  std::string summary_record(std::uint8_t opcode) const;

  std::string bytes_;
  std::uint64_t written_ = 0;  ///< bytes of the file so far
  std::uint32_t crc_ = 0;      ///< of these
  std::vector<std::string> schemas_;
  std::vector<Channel> channels_;
  std::string chunk_;
  Span chunk_span_, span_;
  std::uint64_t messages_ = 0, chunk_messages_ = 0;
  std::map<std::uint16_t, std::vector<IndexEntry>> index_;  ///< of the present chunk
  std::vector<std::string> chunk_indexes_;
};

struct McapMessage {
  std::string topic;
  std::uint64_t time_ns = 0;
  std::string data;
};

/// Whether the bytes begin as such a file does.
bool is_mcap(std::string_view bytes);

/// Bytes of a file that are not as they were written: from `begin` to before `end`; none where the file ends too early.
struct McapDamage {
  std::size_t begin = 0, end = 0;
  std::size_t messages_before = 0;  ///< of those that were read, so many stand before it
  bool hits_messages = true;        ///< or may; else indexes and the like, which nobody misses who reads from the front
};

/// What is whole of a file.
struct McapContents {
  std::vector<McapMessage> messages;           ///< the topic is empty where what named it is damaged
  std::vector<McapDamage> damage;              ///< in the file's order
  std::optional<std::uint64_t> messages_lost;  ///< where it is known how many were written
};

/// A chunk is whole where its checksum holds; behind damage the next one is looked for. Throws InputError naming `file`
/// where it is none, is compressed, or nothing in it is whole.
McapContents read_mcap(std::string_view bytes, const std::string& file);

}  // namespace demecal::inline recording
