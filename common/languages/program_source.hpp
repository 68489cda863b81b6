// The files of a program as one text, and where in it each begins: a program may keep its points, tools and frames in
// other files than its motions.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace demecal::inline languages {

struct ProgramFile {
  std::string name;  ///< as named to the user
  std::string text;
};

/// One file after the other, each beginning a line of its own.
class ProgramSource {
 public:
  ProgramSource(std::string_view text, std::string file);
  /// At least one file.
  explicit ProgramSource(std::vector<ProgramFile> files);

  const std::string& text() const { return text_; }
  const std::vector<ProgramFile>& files() const { return files_; }
  /// The name of the first.
  const std::string& file() const { return files_.front().name; }
  /// Where the text of a file begins, its byte order mark (blanks here, unless it is the first) included.
  std::size_t begin(std::size_t file) const { return begins_[file]; }
  /// The file that a byte of the text is of; the line break between two is of the first.
  std::size_t file_at(std::size_t offset) const;

 private:
  std::vector<ProgramFile> files_;
  std::vector<std::size_t> begins_;
  std::string text_;
};

}  // namespace demecal::inline languages
