#include "languages/payload_statements.hpp"

#include <algorithm>
#include <cstddef>
#include <map>
#include <optional>
#include <string>
#include <string_view>

#include "data/text.hpp"

namespace demecal::inline languages {
namespace {

/// Where the statement's argument begins in a line that begins with it; npos: it does not.
std::size_t argument_in(std::string_view line, std::string_view statement) {
  const std::string_view word = statement.substr(0, statement.size() - 1);
  if (!line.starts_with(word)) return std::string_view::npos;
  const std::size_t next = std::min(line.find_first_not_of(" \t", word.size()), line.size());
  const char behind = next == line.size() ? '\0' : line[next];
  if (statement.back() == ' ') return next > word.size() && behind != '\0' && behind != '=' ? next : line.npos;
  return behind == statement.back() ? next + 1 : line.npos;
}

/// In small letters, without the lines that are comments.
std::string code_without_comments(std::string_view text, std::string_view comment) {
  std::string code = lower_case(text);
  for (std::size_t begin = 0; begin < code.size();) {
    const std::size_t end = std::min(code.find('\n', begin), code.size());
    const std::size_t first = std::min(code.find_first_not_of(" \t", begin), end);
    if (std::string_view(code).substr(first, end - first).starts_with(comment))
      std::fill(code.begin() + static_cast<std::ptrdiff_t>(first), code.begin() + static_cast<std::ptrdiff_t>(end),
                ' ');
    begin = end + 1;
  }
  return code;
}

}  // namespace

std::vector<PayloadStatement> payload_statements_of(const Language& language, const ProgramSource& source) {
  std::vector<PayloadStatement> found;
  if (language.payload_statements.empty()) return found;
  const std::string code = code_without_comments(source.text(), language.comment);
  std::map<std::string_view, std::optional<double>> read;  ///< the same words mean the same load
  for (std::size_t file = 0; file < source.files().size(); ++file) {
    const std::size_t file_end = std::min(source.begin(file) + source.files()[file].text.size(), code.size());
    for (std::size_t begin = source.begin(file), line = 1; begin < file_end; ++line) {
      const std::size_t end = std::min(code.find('\n', begin), file_end);
      const std::size_t first = std::min(code.find_first_not_of(" \t:0123456789", begin), end);
      const std::string_view statement = std::string_view(code).substr(first, end - first);
      for (const PayloadWords& words : language.payload_statements) {
        const std::size_t argument = argument_in(statement, words.begin);
        if (argument == std::string_view::npos) continue;
        PayloadStatement one{{line, first - begin + 1, file}, first, {}};
        if (words.kg != nullptr) {
          const auto [same, fresh] = read.try_emplace(statement);
          if (fresh) same->second = words.kg(code, first + argument);
          one.kg = same->second;
        }
        found.push_back(one);
        break;
      }
      begin = end + 1;
    }
  }
  return found;
}

}  // namespace demecal::inline languages
