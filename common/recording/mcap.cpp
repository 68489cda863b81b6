#include "recording/mcap.hpp"

#include <algorithm>
#include <array>
#include <map>
#include <utility>

#include "errors/check.hpp"
#include "recording/mcap_records.hpp"

namespace demecal::inline recording {
namespace {

constexpr std::array<std::uint32_t, 256> kRemainders = [] {
  std::array<std::uint32_t, 256> table{};
  for (std::uint32_t i = 0; i < table.size(); ++i) {
    std::uint32_t value = i;
    for (int bit = 0; bit < 8; ++bit) value = value >> 1U ^ (0xEDB88320U & (0U - (value & 1U)));
    table[i] = value;
  }
  return table;
}();

constexpr std::size_t kMostNumbers = 65535;  // of schemas and channels, which have two bytes

}  // namespace

std::uint32_t crc32(std::string_view bytes, std::uint32_t before) {
  std::uint32_t crc = ~before;
  for (const char byte : bytes) crc = kRemainders[(crc ^ static_cast<unsigned char>(byte)) & 0xFFU] ^ crc >> 8U;
  return ~crc;
}

McapWriter::McapWriter(const std::string& library) {
  std::string header;
  put_text(header, "");
  put_text(header, library);
  append(std::string(kMcapMagic) + mcap_record(McapRecord::header, header));
}

std::uint16_t McapWriter::add_schema(const std::string& name, const std::string& json_schema) {
  DEMECAL_CHECK(schemas_.size() < kMostNumbers, "schemas=" << schemas_.size());
  const auto number = static_cast<std::uint16_t>(schemas_.size() + 1);  // 0 means none
  std::string content;
  put<std::uint16_t>(content, number);
  put_text(content, name);
  put_text(content, "jsonschema");
  put_text(content, json_schema);
  schemas_.push_back(mcap_record(McapRecord::schema, content));
  chunk_ += schemas_.back();
  return number;
}

std::uint16_t McapWriter::add_channel(std::uint16_t schema, const std::string& topic) {
  DEMECAL_CHECK(channels_.size() < kMostNumbers, "channels=" << channels_.size());
  const auto number = static_cast<std::uint16_t>(channels_.size());
  std::string content;
  put<std::uint16_t>(content, number);
  put<std::uint16_t>(content, schema);
  put_text(content, topic);
  put_text(content, "json");
  put_text(content, "");  // no metadata
  channels_.push_back({mcap_record(McapRecord::channel, content)});
  chunk_ += channels_.back().record;
  return number;
}

void McapWriter::add_message(std::uint16_t channel, std::uint64_t time_ns, std::string_view json) {
  std::string content;
  put<std::uint16_t>(content, channel);
  put<std::uint32_t>(content, channels_.at(channel).sequence++);
  put<std::uint64_t>(content, time_ns);  // when it was recorded,
  put<std::uint64_t>(content, time_ns);  // and, as far as is known, published
  content += json;
  index_[channel].push_back({time_ns, chunk_.size()});
  chunk_ += mcap_record(McapRecord::message, content);
  chunk_span_.extend(time_ns, chunk_messages_++ == 0);
  span_.extend(time_ns, messages_++ == 0);
  ++channels_[channel].messages;
}

void McapWriter::Span::extend(std::uint64_t time_ns, bool is_first) {
  begin_ns = is_first ? time_ns : std::min(begin_ns, time_ns);
  end_ns = is_first ? time_ns : std::max(end_ns, time_ns);
}

void McapWriter::end_chunk() {
  if (chunk_.empty()) return;
  std::string content;
  put<std::uint64_t>(content, chunk_span_.begin_ns);
  put<std::uint64_t>(content, chunk_span_.end_ns);
  put<std::uint64_t>(content, chunk_.size());
  put<std::uint32_t>(content, crc32(chunk_));
  put_text(content, "");  // not compressed
  put<std::uint64_t>(content, chunk_.size());
  content += chunk_;
  const std::uint64_t chunk_begin = written_;
  append(mcap_record(McapRecord::chunk, content));
  const std::uint64_t chunk_end = written_;
  std::string offsets;
  for (const auto& [channel, entries] : index_) {
    put<std::uint16_t>(offsets, channel);
    put<std::uint64_t>(offsets, written_);
    std::string index;
    put<std::uint16_t>(index, channel);
    put<std::uint32_t>(index, static_cast<std::uint32_t>(16 * entries.size()));
    for (const IndexEntry& entry : entries) {
      put<std::uint64_t>(index, entry.time_ns);
      put<std::uint64_t>(index, entry.offset);
    }
    append(mcap_record(McapRecord::message_index, index));
  }
  std::string index;
  put<std::uint64_t>(index, chunk_span_.begin_ns);
  put<std::uint64_t>(index, chunk_span_.end_ns);
  put<std::uint64_t>(index, chunk_begin);
  put<std::uint64_t>(index, chunk_end - chunk_begin);
  put_text(index, offsets);
  put<std::uint64_t>(index, written_ - chunk_end);
  put_text(index, "");
  put<std::uint64_t>(index, chunk_.size());
  put<std::uint64_t>(index, chunk_.size());
  chunk_indexes_.push_back(mcap_record(McapRecord::chunk_index, index));
  chunk_.clear();
  chunk_span_ = {};
  chunk_messages_ = 0;
  index_.clear();
}

/// All records of the summary that have this opcode.
std::string McapWriter::summary_record(std::uint8_t opcode) const {
  std::string all;
  switch (static_cast<McapRecord>(opcode)) {
    case McapRecord::schema:
      for (const std::string& schema : schemas_) all += schema;
      return all;
    case McapRecord::channel:
      for (const Channel& channel : channels_) all += channel.record;
      return all;
    case McapRecord::chunk_index:
      for (const std::string& index : chunk_indexes_) all += index;
      return all;
    default:
      break;
  }
  std::string content, counts;
  for (std::size_t channel = 0; channel < channels_.size(); ++channel) {
    put<std::uint16_t>(counts, static_cast<std::uint16_t>(channel));
    put<std::uint64_t>(counts, channels_[channel].messages);
  }
  put<std::uint64_t>(content, messages_);
  put<std::uint16_t>(content, static_cast<std::uint16_t>(schemas_.size()));
  put<std::uint32_t>(content, static_cast<std::uint32_t>(channels_.size()));
  put<std::uint32_t>(content, 0);  // attachments
  put<std::uint32_t>(content, 0);  // metadata
  put<std::uint32_t>(content, static_cast<std::uint32_t>(chunk_indexes_.size()));
  put<std::uint64_t>(content, span_.begin_ns);
  put<std::uint64_t>(content, span_.end_ns);
  put_text(content, counts);
  return mcap_record(McapRecord::statistics, content);
}

void McapWriter::finish() {
  end_chunk();
  std::string data_end;
  put<std::uint32_t>(data_end, crc_);
  append(mcap_record(McapRecord::data_end, data_end));
  const std::uint64_t summary_begin = written_;
  std::string summary, offsets;
  for (const McapRecord group :
       {McapRecord::schema, McapRecord::channel, McapRecord::statistics, McapRecord::chunk_index}) {
    const std::string records = summary_record(static_cast<std::uint8_t>(group));
    if (records.empty()) continue;
    std::string offset;
    put<std::uint8_t>(offset, static_cast<std::uint8_t>(group));
    put<std::uint64_t>(offset, summary_begin + summary.size());
    put<std::uint64_t>(offset, records.size());
    offsets += mcap_record(McapRecord::summary_offset, offset);
    summary += records;
  }
  std::string footer;
  put<std::uint64_t>(footer, summary_begin);
  put<std::uint64_t>(footer, summary_begin + summary.size());
  put<std::uint32_t>(footer, 0);
  summary += offsets + mcap_record(McapRecord::footer, footer);
  summary.resize(summary.size() - sizeof(std::uint32_t));
  put<std::uint32_t>(summary, crc32(summary));  // of all before it
  append(summary + std::string(kMcapMagic));
}

void McapWriter::append(const std::string& bytes) {
  bytes_ += bytes;
  written_ += bytes.size();
  crc_ = crc32(bytes, crc_);
}

std::string McapWriter::take_bytes() {
  return std::exchange(bytes_, {});
}

}  // namespace demecal::inline recording
