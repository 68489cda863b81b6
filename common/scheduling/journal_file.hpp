// The file of a journal: held by one process, appended to, and never left with half of what was to be written; and its
// records as bytes, each with its length and checksum, so that a torn tail shows.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace demecal::inline scheduling {

class JournalFile {
 public:
  /// Opens the file, making it where it is missing, for this process alone. Throws InputError where it cannot be
  /// opened, or another process holds it.
  explicit JournalFile(std::string path);
  ~JournalFile();
  JournalFile(const JournalFile&) = delete;
  JournalFile& operator=(const JournalFile&) = delete;

  const std::string& path() const { return path_; }
  std::size_t size() const { return size_; }

  // What follows throws std::runtime_error naming file and reason where it cannot be done.

  std::string read() const;
  /// All of the bytes or, where that fails as on a full disk, none of them.
  void append(std::string_view bytes);
  /// What was appended survives a failure of the power from now on.
  void sync();
  /// Leaves only the first `size` bytes.
  void cut(std::size_t size);
  /// Other contents in place of all there are, at once; as they were where that fails.
  void replace(std::string_view bytes);
  /// The name is gone; the file goes with this object.
  void remove();

 private:
  [[noreturn]] void fail(const std::string& what, int number) const;

  std::string path_;
  int file_ = -1;
  std::size_t size_ = 0;
};

/// CRC-32C (Castagnoli; RFC 3720, B.4) of the bytes.
std::uint32_t crc32c(std::string_view bytes);

/// Integers of a journal: four bytes, the lowest first.
std::string bytes_of(std::uint32_t number);
/// The number that the first four of the bytes are; there must be as many.
std::uint32_t number_of(std::string_view bytes);

/// What a journal begins with; the number is the version of its format.
inline constexpr std::string_view kJournalHead = "demecal journal 5\n";

/// The record as it stands in a journal: the length of `content`, a checksum of length and content, the content.
/// `content` must be shorter than 4 GiB.
std::string record_of(std::string_view content);

/// How a journal ends: as written, amid a record, or with a record whose checksum is wrong.
enum class JournalEnd { clean, torn, corrupt };

struct JournalRecords {
  std::vector<std::string_view> contents;  ///< of the sound records, in order; views into the bytes that were read
  std::size_t sound_bytes = 0;             ///< how much of the journal they are, its head included; 0 without a head
  JournalEnd end = JournalEnd::clean;
};

/// The records up to the first that is torn or corrupt: nothing after it is believed. Bytes that are the beginning of a
/// head (none among them) are a torn journal without records; other bytes that do not begin with a head a corrupt one.
JournalRecords read_records(std::string_view journal);

}  // namespace demecal::inline scheduling
