#include <algorithm>
#include <cctype>
#include <map>

#include "rules.hpp"

namespace demecal::map {
namespace {

constexpr std::size_t kLinesOfPassage = 13;

struct CodeLine {
  int number = 0;
  std::string words;  ///< without white space
};

std::vector<CodeLine> code_lines(const Source& source) {
  std::vector<CodeLine> lines;
  int number = 0;
  for (std::string line : lines_of(without_comments(source.text))) {
    ++number;
    std::erase_if(line, [](unsigned char letter) { return std::isspace(letter) != 0; });
    const bool says_something =
        std::ranges::any_of(line, [](unsigned char letter) { return std::isalnum(letter) != 0; });
    if (says_something && !line.starts_with("#include")) lines.push_back({number, line});
  }
  return lines;
}

}  // namespace

Violations check_passages_once(const std::vector<Source>& sources) {
  std::map<std::string, std::string> first;  // place by the passage's words
  Violations found;
  for (const Source& source : sources) {
    const std::vector<CodeLine> lines = code_lines(source);
    for (std::size_t begin = 0; begin + kLinesOfPassage <= lines.size(); ++begin) {
      std::string passage;
      for (std::size_t i = begin; i < begin + kLinesOfPassage; ++i) passage += lines[i].words + '\n';
      const int number = lines[begin].number;
      const auto [known, fresh] = first.try_emplace(passage, source.path + ':' + std::to_string(number));
      if (fresh) continue;
      found.push_back({source.path, number, "13 lines that stand already at " + known->second});
      begin += kLinesOfPassage - 1;
    }
  }
  return found;
}

}  // namespace demecal::map
