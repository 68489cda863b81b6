#include "languages/csv_fields.hpp"

#include <algorithm>
#include <string_view>

namespace demecal::inline languages {
namespace {

CsvField quoted_field(const ProgramText& text, std::size_t begin, std::size_t end, std::size_t& at) {
  const std::size_t quote = text.text().find('"', begin + 1);
  if (quote >= end) text.fail(begin, end - begin, "opens a quote that its line does not close");
  at = text.text().find_first_not_of(" \t", quote + 1);
  return {begin + 1, quote - begin - 1};
}

}  // namespace

std::vector<CsvField> csv_fields(const ProgramText& text, std::size_t begin, std::size_t end, char separator) {
  const std::string_view line = text.text().substr(0, end);
  const std::string_view blanks = separator == '\t' ? " " : " \t";
  std::vector<CsvField> found;
  for (std::size_t at = begin;; ++at) {
    const std::size_t first = std::min(line.find_first_not_of(blanks, at), end);
    if (first < end && line[first] == '"') {
      found.push_back(quoted_field(text, first, end, at));
      at = std::min(at, end);
      if (at < end && line[at] != separator) text.fail(at, 1, "is text after a closing quote");
    } else {
      at = std::min(line.find(separator, first), end);
      const std::string_view value = line.substr(first, at - first);
      found.push_back({first, value.find_last_not_of(" \t") + 1});
    }
    if (at == end) return found;
  }
}

}  // namespace demecal::inline languages
