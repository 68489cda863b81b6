#include "languages/fanuc_ls_motions.hpp"

#include <algorithm>
#include <cmath>
#include <string_view>

#include "data/text.hpp"

namespace demecal::inline languages {
namespace {

const std::string kIncrement = "a motion goes by it and not to it (INC)";
const std::string kOffset =
    "a motion to it also names a register or an offset, which is computed when the program runs";

bool is_blank(char letter) {
  return letter == ' ' || letter == '\t' || letter == '\r' || letter == '\n';
}

/// "  12:  P[3]=LPOS" and "P[3,2:y]=...", also behind IF.
void find_changes(const ProgramText& text, std::size_t begin, std::size_t end, ChangedNames& changes) {
  const std::string_view code = text.code().substr(0, end);
  while (begin < end && (is_blank(code[begin]) || is_digit(code[begin]) || code[begin] == ':')) ++begin;
  if (begin < end && code[begin] == '!') return;  // a remark
  for (std::size_t at = begin; at < end; ++at) {
    if (!text.begins_word(at) || text.word_at(at) != "p") continue;
    const std::size_t open = text.skip_spaces(text.word_end(at));
    if (open >= end || code[open] != '[') continue;
    std::size_t close = open;
    for (int depth = 0; close < end; ++close) {
      depth += code[close] == '[' ? 1 : code[close] == ']' ? -1 : 0;
      if (depth == 0) break;
    }
    const std::size_t sign = close < end ? text.skip_spaces(close + 1) : end;
    if (sign >= end || code[sign] != '=') continue;
    const std::size_t index_end = std::min(code.find_first_of(":,", open), close);
    changes.changed("P[" + std::string(code.substr(open + 1, index_end - open - 1)) + ']', at);
  }
}

}  // namespace

int position_number(const ProgramText& text, std::size_t open) {
  constexpr double kMost = 1e6;
  std::size_t begin = open + 1;
  const std::size_t end = std::min(text.code().find_first_of(":]", begin), text.code().size());
  const std::string_view word = text.trimmed(begin, end);
  const auto number = cell_at(text.text(), begin, word.size(), {});
  const bool counts =
      number && number->value >= 0.0 && number->value <= kMost && number->value == std::floor(number->value);
  return counts ? static_cast<int>(number->value) : -1;
}

void FanucMotions::read(const ProgramText& text, std::size_t begin, std::size_t end, ChangedNames& changes) {
  while (begin < end) {
    const std::size_t stop = std::min(text.code().find(';', begin), end);
    read_statement(text, begin, stop);
    find_changes(text, begin, stop, changes);
    begin = stop + 1;
  }
}

/// "  12:L P[3] 100mm/sec FINE INC", its line number and line breaks included.
void FanucMotions::read_statement(const ProgramText& text, std::size_t begin, std::size_t end) {
  const std::string_view code = text.code().substr(0, end);
  while (begin < end && (is_blank(code[begin]) || is_digit(code[begin]) || code[begin] == ':')) ++begin;
  constexpr std::string_view kLines = "lca";
  const std::string kind = lower_case(code.substr(begin, std::min<std::size_t>(1, end - begin)));
  const bool line = !kind.empty() && kLines.find(kind) != std::string_view::npos;
  if (!line && kind != "j") return;
  if (begin + 1 >= end || is_word_letter(code[begin + 1])) return;
  std::vector<int> numbers;
  std::string why;
  for (std::size_t at = begin + 1; at < end; ++at) {
    if (!text.begins_word(at)) continue;
    const std::size_t word_end = std::min(text.word_end(at), end);
    const std::string word = lower_case(code.substr(at, word_end - at));
    const bool indexed = text.next(word_end) == '[' && text.skip_spaces(word_end) < end;
    if (word == "p" && indexed) numbers.push_back(position_number(text, text.skip_spaces(word_end)));
    if (word == "inc") why = kIncrement;
    if (why.empty() && ((indexed && (word == "pr" || word == "vr")) || word.ends_with("offset"))) why = kOffset;
    at = word_end - 1;
  }
  if (numbers.empty() && why == kOffset) to_registers_.push_back(begin);
  const bool indirect = std::any_of(numbers.begin(), numbers.end(), [](int number) { return number < 0; });
  if (!why.empty() || indirect) elsewhere_.push_back(begin);
  for (const int number : numbers) {
    if (number < 0 && !why.empty()) computed_numbers_ = "a motion may go by it: " + why;
    if (number >= 0 && !why.empty()) not_sent_to_[number] = why;
    if (number >= 0) uses_[number].push_back({begin, line ? Motion::line : Motion::joints, {}});
  }
}

std::string FanucMotions::not_sent_to(int number) const {
  const auto found = not_sent_to_.find(number);
  return found == not_sent_to_.end() ? computed_numbers_ : found->second;
}

void FanucMotions::complete(int number, Target& target) const {
  target.order = target.begin();
  const auto found = uses_.find(number);
  if (found == uses_.end()) return;
  std::vector<TargetUse> uses = found->second;
  for (TargetUse& use : uses) use.frames = target.frames;
  take_uses(uses, target);
}

}  // namespace demecal::inline languages
