#include "languages/program_source.hpp"

#include <algorithm>
#include <iterator>
#include <utility>

#include "errors/check.hpp"

namespace demecal::inline languages {

ProgramSource::ProgramSource(std::string_view text, std::string file)
    : ProgramSource(std::vector<ProgramFile>{{std::move(file), std::string(text)}}) {}

ProgramSource::ProgramSource(std::vector<ProgramFile> files) : files_(std::move(files)) {
  constexpr std::string_view kByteOrderMark = "\xEF\xBB\xBF";
  DEMECAL_CHECK(!files_.empty(), "a program has a file");
  for (const ProgramFile& file : files_) {
    if (!begins_.empty()) text_ += '\n';
    begins_.push_back(text_.size());
    text_ += file.text;
    if (begins_.size() > 1 && file.text.starts_with(kByteOrderMark)) text_.replace(begins_.back(), 3, 3, ' ');
  }
}

std::size_t ProgramSource::file_at(std::size_t offset) const {
  return static_cast<std::size_t>(std::upper_bound(begins_.begin(), begins_.end(), offset) - begins_.begin()) - 1;
}

}  // namespace demecal::inline languages
