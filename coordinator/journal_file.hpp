// The file of a journal: held by one process, appended to, and never left with half of what was to be written.
#pragma once

#include <string>
#include <string_view>

namespace demecal {

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

}  // namespace demecal
