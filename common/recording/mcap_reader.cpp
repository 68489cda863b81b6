#include <algorithm>
#include <iterator>
#include <map>
#include <optional>
#include <utility>

#include "errors/input_error.hpp"
#include "recording/mcap.hpp"
#include "recording/mcap_records.hpp"

namespace demecal::inline recording {
namespace {

constexpr std::size_t kCrc_bytes = 4;

struct Record {
  McapRecord opcode{};
  std::string_view content;
  std::size_t end = 0;  ///< the place behind it
};

/// The record that stands at `at`; nothing where the bytes end before it does.
std::optional<Record> record_at(std::string_view bytes, std::size_t at) {
  McapFields fields{bytes.substr(at)};
  Record record{static_cast<McapRecord>(fields.number<std::uint8_t>()), {}, 0};
  record.content = fields.take(fields.number<std::uint64_t>());
  if (!fields.is_whole) return std::nullopt;
  record.end = bytes.size() - fields.bytes.size();
  return record;
}

struct Chunk {
  std::string_view compression, records;
  bool is_right = false;  ///< by its checksum
};

/// Nothing where the lengths in the chunk's head contradict the record's.
std::optional<Chunk> chunk_of(const Record& record) {
  if (record.opcode != McapRecord::chunk) return std::nullopt;
  McapFields fields{record.content};
  fields.take(16);  // first and last time
  const auto size = fields.number<std::uint64_t>();
  const auto crc = fields.number<std::uint32_t>();
  Chunk chunk;
  chunk.compression = fields.text();
  chunk.records = fields.take(fields.number<std::uint64_t>());
  const bool is_plain = chunk.compression.empty();
  if (!fields.is_whole || !fields.bytes.empty() || (is_plain && size != chunk.records.size())) return std::nullopt;
  chunk.is_right = !is_plain || crc == 0 || crc32(chunk.records) == crc;
  return chunk;
}

bool is_data_end(const Record& record) {
  return record.opcode == McapRecord::data_end && record.content.size() == kCrc_bytes;
}

/// Reads channels and messages, from one run of records after the other.
struct McapTopics {
  std::map<std::uint16_t, std::string> names;

  /// Whether the record is whole; a message is appended.
  bool take(const Record& record, std::vector<McapMessage>& messages) {
    McapFields fields{record.content};
    if (record.opcode == McapRecord::channel) {
      const auto number = fields.number<std::uint16_t>();
      fields.number<std::uint16_t>();  // its schema
      std::string name(fields.text());
      if (fields.is_whole) names[number] = std::move(name);
    }
    if (record.opcode == McapRecord::message) {
      const auto name = names.find(fields.number<std::uint16_t>());
      fields.number<std::uint32_t>();  // its place in the channel
      const auto time_ns = fields.number<std::uint64_t>();
      fields.number<std::uint64_t>();  // when it was published
      if (fields.is_whole)
        messages.push_back({name == names.end() ? "" : name->second, time_ns, std::string(fields.bytes)});
    }
    return fields.is_whole;
  }
};

/// What stands behind the messages: enough to know how many there were, and of which channels.
struct Summary {
  std::size_t begin = 0;
  std::map<std::uint16_t, std::string> topics;
  std::optional<std::uint64_t> messages;
};

/// Nothing where the file has none, or one whose checksum is wrong.
std::optional<Summary> read_summary(std::string_view bytes) {
  constexpr std::size_t kFooter_bytes = 1 + 8 + 8 + 8 + kCrc_bytes;
  const std::size_t least = 2 * kMcapMagic.size() + kFooter_bytes;
  if (bytes.size() < least || !bytes.ends_with(kMcapMagic)) return std::nullopt;
  const std::string_view records = bytes.substr(0, bytes.size() - kMcapMagic.size());
  const auto footer = record_at(records, records.size() - kFooter_bytes);
  if (!footer || footer->opcode != McapRecord::footer) return std::nullopt;
  McapFields fields{footer->content};
  Summary summary;
  const auto begin = fields.number<std::uint64_t>();
  fields.number<std::uint64_t>();
  const auto crc = fields.number<std::uint32_t>();
  summary.begin = records.size() - kFooter_bytes;
  if (begin == 0) return summary;  // the footer alone
  if (begin < kMcapMagic.size() || begin > summary.begin) return std::nullopt;
  summary.begin = static_cast<std::size_t>(begin);
  const std::string_view summed = records.substr(summary.begin, records.size() - kCrc_bytes - summary.begin);
  if (crc != 0 && crc != crc32(summed)) return std::nullopt;
  McapTopics topics;
  std::vector<McapMessage> none;
  for (auto record = record_at(records, summary.begin); record; record = record_at(records, record->end)) {
    topics.take(*record, none);
    if (record->opcode == McapRecord::statistics)
      summary.messages = McapFields{record->content}.number<std::uint64_t>();
  }
  summary.topics = std::move(topics.names);
  return summary;
}

class McapReader {
 public:
  McapReader(std::string_view bytes, const std::string& file)
      : bytes_(bytes), file_(file), summary_(read_summary(bytes)), data_(bytes) {
    if (!summary_) return;
    data_ = bytes.substr(0, summary_->begin);
    topics_.names = summary_->topics;
  }

  McapContents read() {
    std::size_t at = kMcapMagic.size();
    while (at < data_.size()) {
      const auto record = record_at(data_, at);
      if (record && is_data_end(*record)) {
        read_end(at, *record);
        return finished();
      }
      if (record && take(*record)) {
        at = record->end;
        continue;
      }
      const std::size_t next = next_whole(at + 1);
      is_contradictory_ |= record.has_value() || next < data_.size();
      note(at, next, true);
      at = next;
    }
    const bool is_noted = !contents_.damage.empty() && contents_.damage.back().end == at;
    if (!summary_ && !is_noted) note(at, at, true);
    return finished();
  }

 private:
  /// Whether the record is one that may stand before the summary, and is whole.
  bool take(const Record& record) {
    switch (record.opcode) {
      case McapRecord::chunk:
        return take_chunk(record);
      case McapRecord::message_index: {
        McapFields fields{record.content};
        fields.number<std::uint16_t>();  // its channel
        const auto length = fields.number<std::uint32_t>();
        return fields.is_whole && fields.bytes.size() == length;
      }
      case McapRecord::message:
        if (!topics_.names.contains(McapFields{record.content}.number<std::uint16_t>())) return false;
        [[fallthrough]];
      case McapRecord::header:
      case McapRecord::schema:
      case McapRecord::channel:
      case McapRecord::attachment:
      case McapRecord::metadata:
        return topics_.take(record, contents_.messages);
      default:
        return false;
    }
  }

  bool take_chunk(const Record& record) {
    const std::optional<Chunk> chunk = chunk_of(record);
    if (!chunk || !chunk->is_right) return false;
    if (chunk->compression == "lz4" || chunk->compression == "zstd")
      throw InputError({file_, 0}, "", "is compressed: only recordings of `demecal monitor --record` are read");
    if (!chunk->compression.empty()) return false;
    std::vector<McapMessage> messages;
    for (std::size_t at = 0; at < chunk->records.size();) {
      const auto inner = record_at(chunk->records, at);
      if (!inner || inner->opcode == McapRecord::chunk || !topics_.take(*inner, messages)) return false;
      at = inner->end;
    }
    std::ranges::move(messages, std::back_inserter(contents_.messages));
    return true;
  }

  /// The place of the next whole chunk or of the end of all messages, from `at` on; or that of the end of the bytes.
  std::size_t next_whole(std::size_t at) const {
    for (; at < data_.size(); ++at) {
      const auto opcode = static_cast<McapRecord>(data_[at]);
      if (opcode != McapRecord::chunk && opcode != McapRecord::data_end) continue;
      const auto record = record_at(data_, at);
      if (!record) continue;
      if (is_data_end(*record)) return at;
      const auto chunk = chunk_of(*record);
      if (chunk && chunk->is_right) return at;
    }
    return at;
  }

  /// A wrong checksum of all together, where that of every chunk is right, is one of their heads or indexes.
  void read_end(std::size_t at, const Record& end) {
    const auto crc = McapFields{end.content}.number<std::uint32_t>();
    if (contents_.damage.empty() && crc != 0 && crc != crc32(data_.substr(0, at))) note(0, end.end, false);
    if (!summary_) note(end.end, bytes_.size(), false);
  }

  void note(std::size_t begin, std::size_t end, bool hits_messages) {
    contents_.damage.push_back({begin, end, contents_.messages.size(), hits_messages});
  }

  McapContents finished() {
    const std::uint64_t read = contents_.messages.size();
    if (read == 0 && is_contradictory_) throw InputError({file_, 0}, "", "is damaged, and nothing in it is whole");
    if (summary_ && summary_->messages) {
      contents_.messages_lost = std::max(*summary_->messages, read) - read;
      for (McapDamage& damage : contents_.damage) damage.hits_messages &= *contents_.messages_lost > 0;
    }
    return std::move(contents_);
  }

  std::string_view bytes_;
  const std::string& file_;
  std::optional<Summary> summary_;
  std::string_view data_;  ///< what stands before the summary
  McapTopics topics_;
  McapContents contents_;
  bool is_contradictory_ = false;
};

}  // namespace

bool is_mcap(std::string_view bytes) {
  return bytes.starts_with(kMcapMagic);
}

McapContents read_mcap(std::string_view bytes, const std::string& file) {
  if (!is_mcap(bytes)) throw InputError({file, 0}, "", "is no MCAP file");
  return McapReader(bytes, file).read();
}

}  // namespace demecal::inline recording
