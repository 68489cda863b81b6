#include "journal/records.hpp"

#include <array>

#include "errors/check.hpp"

namespace demecal {
namespace {

constexpr std::uint32_t kReversedPolynomial = 0x82F63B78;

constexpr std::array<std::uint32_t, 256> kChecksumTable = [] {
  std::array<std::uint32_t, 256> table{};
  for (std::uint32_t byte = 0; byte < table.size(); ++byte) {
    std::uint32_t value = byte;
    for (int bit = 0; bit < 8; ++bit) value = (value >> 1) ^ ((value & 1) != 0 ? kReversedPolynomial : 0);
    table[byte] = value;
  }
  return table;
}();

constexpr std::size_t kNumber_bytes = 4;
constexpr std::size_t kPrefix_bytes = 2 * kNumber_bytes;

std::uint32_t checksum(std::string_view length, std::string_view content) {
  return crc32c(std::string(length).append(content));
}

}  // namespace

std::uint32_t crc32c(std::string_view bytes) {
  std::uint32_t value = 0xFFFFFFFF;
  for (const char byte : bytes) value = (value >> 8) ^ kChecksumTable[(value ^ static_cast<std::uint8_t>(byte)) & 0xFF];
  return ~value;
}

std::string bytes_of(std::uint32_t number) {
  std::string bytes(kNumber_bytes, '\0');
  for (std::size_t i = 0; i < kNumber_bytes; ++i) bytes[i] = static_cast<char>((number >> (8 * i)) & 0xFF);
  return bytes;
}

std::uint32_t number_of(std::string_view bytes) {
  DEMECAL_CHECK(bytes.size() >= kNumber_bytes, "bytes=" << bytes.size());
  std::uint32_t number = 0;
  for (std::size_t i = 0; i < kNumber_bytes; ++i)
    number |= static_cast<std::uint32_t>(static_cast<std::uint8_t>(bytes[i])) << (8 * i);
  return number;
}

std::string record_of(std::string_view content) {
  DEMECAL_CHECK(content.size() <= 0xFFFFFFFF, "bytes=" << content.size());
  std::string record = bytes_of(static_cast<std::uint32_t>(content.size()));
  record += bytes_of(checksum(record, content));
  return record.append(content);
}

JournalRecords read_records(std::string_view journal) {
  JournalRecords records;
  const std::string_view head = journal.substr(0, kJournalHead.size());
  if (head != kJournalHead) {
    records.end = kJournalHead.starts_with(head) ? JournalEnd::torn : JournalEnd::corrupt;
    return records;
  }
  records.sound_bytes = head.size();
  while (records.sound_bytes < journal.size()) {
    const std::string_view rest = journal.substr(records.sound_bytes);
    records.end = JournalEnd::torn;
    if (rest.size() < kPrefix_bytes) return records;
    const std::string_view length = rest.substr(0, kNumber_bytes);
    const std::string_view content = rest.substr(kPrefix_bytes, number_of(length));
    if (content.size() < number_of(length)) return records;
    records.end = JournalEnd::corrupt;
    if (number_of(rest.substr(kNumber_bytes)) != checksum(length, content)) return records;
    records.end = JournalEnd::clean;
    records.contents.push_back(content);
    records.sound_bytes += kPrefix_bytes + content.size();
  }
  return records;
}

}  // namespace demecal
