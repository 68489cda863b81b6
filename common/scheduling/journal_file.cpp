#include "scheduling/journal_file.hpp"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>
#include <array>
#include <cerrno>
#include <csignal>
#include <cstdio>
#include <stdexcept>
#include <system_error>
#include <utility>

#include "errors/check.hpp"
#include "errors/input_error.hpp"

namespace demecal::inline scheduling {
namespace {

/// The file, locked, or -1 with errno.
int open_locked(const std::string& path, int more_flags) {
  // Workers that this program starts must not inherit the lock.
  const int file = ::open(path.c_str(), O_RDWR | O_CREAT | O_CLOEXEC | more_flags, 0644);
  if (file < 0) return -1;
  if (::flock(file, LOCK_EX | LOCK_NB) == 0) return file;
  const int number = errno;
  ::close(file);
  errno = number;
  return -1;
}

/// 0, or the errno of why not all could be written.
int write_all(int file, std::string_view bytes) {
  while (!bytes.empty()) {
    const ssize_t written = ::write(file, bytes.data(), bytes.size());
    if (written < 0 && errno == EINTR) continue;
    if (written < 0) return errno;
    if (written == 0) return ENOSPC;
    bytes.remove_prefix(static_cast<std::size_t>(written));
  }
  return 0;
}

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

JournalFile::JournalFile(std::string path) : path_(std::move(path)) {
  std::signal(SIGXFSZ, SIG_IGN);  // a file as large as it may be is an error to report, not to die of
  file_ = open_locked(path_, O_APPEND);
  if (file_ < 0 && errno == EWOULDBLOCK)
    throw InputError({path_, 0}, "",
                     "another demecal writes its journal there: wait for its end, or choose another folder");
  if (file_ < 0) throw InputError({path_, 0}, "", "the journal cannot be opened: " + system_reason(errno));
  struct stat status {};
  ::fstat(file_, &status);
  size_ = static_cast<std::size_t>(status.st_size);
}

JournalFile::~JournalFile() {
  ::close(file_);
}

std::string JournalFile::read() const {
  std::string bytes(size_, '\0');
  std::size_t at = 0;
  while (at < bytes.size()) {
    const ssize_t got = ::pread(file_, bytes.data() + at, bytes.size() - at, static_cast<off_t>(at));
    if (got < 0 && errno == EINTR) continue;
    if (got < 0) fail("cannot be read", errno);
    if (got == 0) break;
    at += static_cast<std::size_t>(got);
  }
  bytes.resize(at);
  return bytes;
}

void JournalFile::append(std::string_view bytes) {
  if (const int number = write_all(file_, bytes); number != 0) {
    static_cast<void>(::ftruncate(file_, static_cast<off_t>(size_)));  // or it has a torn end, which readers expect
    fail("cannot be written", number);
  }
  size_ += bytes.size();
}

void JournalFile::sync() {
  // Files that are no disk's, as in tests, cannot be synchronised and need not be.
  if (::fdatasync(file_) != 0 && errno != EINVAL && errno != EROFS) fail("cannot be written", errno);
}

void JournalFile::cut(std::size_t size) {
  if (::ftruncate(file_, static_cast<off_t>(size)) != 0) fail("cannot be shortened", errno);
  size_ = size;
}

void JournalFile::replace(std::string_view bytes) {
  const std::string unfinished = path_ + ".part";
  const int other = open_locked(unfinished, O_APPEND | O_TRUNC);
  if (other < 0) fail("cannot be rewritten", errno);
  int number = write_all(other, bytes);
  if (number == 0 && (::fdatasync(other) != 0 || std::rename(unfinished.c_str(), path_.c_str()) != 0)) number = errno;
  if (number != 0) {
    ::close(other);
    std::remove(unfinished.c_str());
    fail("cannot be rewritten", number);
  }
  ::close(file_);
  file_ = other;
  size_ = bytes.size();
}

void JournalFile::remove() {
  if (std::remove(path_.c_str()) != 0) fail("cannot be removed", errno);
}

void JournalFile::fail(const std::string& what, int number) const {
  throw std::runtime_error(path_ + ": the journal " + what + ": " + system_reason(number));
}

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

}  // namespace demecal::inline scheduling
