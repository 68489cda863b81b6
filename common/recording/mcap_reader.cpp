#include "recording/mcap_reader.hpp"

#include <map>

#include "errors/input_error.hpp"
#include "recording/mcap_records.hpp"
#include "recording/mcap_writer.hpp"

namespace demecal::inline recording {
namespace {

class McapReader {
 public:
  explicit McapReader(const std::string& file) : file_(file) {}

  /// Records one after the other; what follows the last whole one is left.
  void read(std::string_view bytes) {
    McapFields fields{bytes};
    while (fields.is_whole && !fields.bytes.empty()) {
      const auto opcode = static_cast<McapRecord>(fields.number<std::uint8_t>());
      const auto length = fields.number<std::uint64_t>();
      const std::string_view content = fields.take(length);
      if (!fields.is_whole || opcode == McapRecord::data_end) return;
      read(opcode, content);
    }
  }

  std::vector<McapMessage> messages;

 private:
  void read(McapRecord opcode, std::string_view content) {
    McapFields fields{content};
    if (opcode == McapRecord::chunk) read_chunk(fields);
    if (opcode == McapRecord::channel) {
      const auto number = fields.number<std::uint16_t>();
      fields.number<std::uint16_t>();  // its schema
      topics_[number] = fields.text();
    }
    if (opcode == McapRecord::message) {
      const auto channel = fields.number<std::uint16_t>();
      fields.number<std::uint32_t>();  // its place in the channel
      const auto time_ns = fields.number<std::uint64_t>();
      fields.number<std::uint64_t>();  // when it was published
      messages.push_back({topics_[channel], time_ns, std::string(fields.bytes)});
    }
    if (!fields.is_whole) refuse("holds a record that is too short: it is damaged");
  }

  void read_chunk(McapFields& fields) {
    fields.take(16);  // first and last time
    fields.number<std::uint64_t>();
    const auto crc = fields.number<std::uint32_t>();
    if (!fields.text().empty()) refuse("is compressed: only recordings of `demecal monitor --record` are read");
    const std::string_view records = fields.take(fields.number<std::uint64_t>());
    if (!fields.is_whole) refuse("holds a chunk that is too short: it is damaged");
    if (crc != 0 && crc32(records) != crc) refuse("holds a chunk whose checksum is wrong: it is damaged");
    if (depth_ > 0) refuse("holds a chunk within a chunk");
    ++depth_;
    read(records);
    --depth_;
  }

  [[noreturn]] void refuse(const std::string& rule) const { throw InputError({file_, 0}, "", rule); }

  const std::string& file_;
  std::map<std::uint16_t, std::string> topics_;
  int depth_ = 0;
};

}  // namespace

bool is_mcap(std::string_view bytes) {
  return bytes.starts_with(kMcapMagic);
}

std::vector<McapMessage> read_mcap(std::string_view bytes, const std::string& file) {
  if (!is_mcap(bytes)) throw InputError({file, 0}, "", "is no MCAP file");
  McapReader reader(file);
  reader.read(bytes.substr(kMcapMagic.size()));
  return std::move(reader.messages);
}

}  // namespace demecal::inline recording
