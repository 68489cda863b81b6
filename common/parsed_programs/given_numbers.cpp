#include "parsed_programs/given_numbers.hpp"

#include <algorithm>
#include <array>
#include <iterator>
#include <string_view>

namespace demecal::inline parsed_programs {
namespace {

/// Words of any language at which a program may come from elsewhere, or go on elsewhere, than in the next line.
bool turns_the_way(std::string_view word) {
  constexpr std::array<std::string_view, 43> kWords{
      "if",     "then",   "else",    "elif",      "elseif", "endif",     "for",    "endfor", "while",
      "do",     "until",  "repeat",  "endwhile",  "loop",   "endloop",   "switch", "case",   "default",
      "end",    "scase",  "value",   "endswitch", "svalue", "any",       "def",    "deffct", "endfct",
      "defdat", "enddat", "thread",  "sec",       "return", "resume",    "exit",   "break",  "continue",
      "halt",   "call",   "trigger", "interrupt", "run",    "pcexecute", "on"};
  return std::find(kWords.begin(), kWords.end(), word) != kWords.end();
}

}  // namespace

GivenNumbers::GivenNumbers(const ProgramText& text) : source_(text.source()) {
  find_routines(text);
  text.for_each_word([&](std::size_t begin, std::size_t end) {
    const std::string word = text.word_at(begin);
    jumps_ = jumps_ || word == "goto";
    if (turns_the_way(word) || (routines_.contains(word) && text.next(end) == '(')) turns_.push_back(begin);
  });
}

/// The names behind DEF, DEFFCT, def and thread: the last word before a parenthesis.
void GivenNumbers::find_routines(const ProgramText& text) {
  text.for_each_word([&](std::size_t begin, std::size_t end) {
    const std::string word = text.word_at(begin);
    if (word != "def" && word != "deffct" && word != "thread" && word != "sec") return;
    std::size_t name = text.skip_spaces(end);
    while (name < text.code().size() && text.begins_word(name) && text.next(text.word_end(name)) != '(')
      name = text.skip_spaces(text.word_end(name));
    if (name < text.code().size() && text.begins_word(name)) routines_.insert(text.word_at(name));
  });
}

std::optional<std::size_t> GivenNumbers::at(const std::string& name, std::size_t motion) const {
  const auto given = given_.find(name);
  if (jumps_ || given == given_.end()) return std::nullopt;
  const auto behind = given->second.lower_bound(motion);
  if (behind == given->second.begin()) return std::nullopt;
  const std::size_t last = *std::prev(behind);
  const auto turn = std::ranges::lower_bound(turns_, last);
  const bool straight = turn == turns_.end() || *turn > motion;
  return straight && source_.file_at(last) == source_.file_at(motion) ? std::optional(last) : std::nullopt;
}

}  // namespace demecal::inline parsed_programs
