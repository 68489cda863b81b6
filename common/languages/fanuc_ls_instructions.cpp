#include "languages/fanuc_ls_instructions.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "data/text.hpp"

namespace demecal::inline languages {
namespace {

bool is_blank(char letter) {
  return letter == ' ' || letter == '\t' || letter == '\r' || letter == '\n';
}

/// "7" of [7:up], and of [1,7], which names the first group of motion; nothing where it names another group.
std::optional<std::string> changed_number(std::string_view indices, bool of_group) {
  const std::size_t comma = indices.find(',');
  if (of_group && comma != std::string_view::npos) {
    if (!is_first_group(indices.substr(0, comma))) return std::nullopt;
    indices.remove_prefix(comma + 1);
  }
  return std::string(indices.substr(0, indices.find_first_of(":,")));
}

/// Whether [begin, end) is nothing but PR[..] or P[..], all of it.
bool is_whole_position(const ProgramText& text, std::size_t begin, std::size_t end) {
  begin = std::min(text.skip_spaces(begin), end);
  if (begin >= end || !text.begins_word(begin)) return false;
  const std::string word = text.word_at(begin);
  const std::size_t open = text.skip_spaces(text.word_end(begin));
  if ((word != "p" && word != "pr") || open >= end || text.code()[open] != '[') return false;
  const std::size_t close = closing_bracket(text.code(), open, end);
  if (close >= end || text.skip_spaces(close + 1) < end) return false;
  return text.code().substr(open, close - open).find(',') == std::string_view::npos;
}

}  // namespace

std::size_t after_line_number(std::string_view code, std::size_t begin) {
  while (begin < code.size() && (is_blank(code[begin]) || is_digit(code[begin]) || code[begin] == ':')) ++begin;
  return begin;
}

bool is_fanuc_motion(std::string_view code, std::size_t begin) {
  if (begin + 1 >= code.size() || is_word_letter(code[begin + 1])) return false;
  return std::string_view("jJlLcCaAsS").find(code[begin]) != std::string_view::npos;
}

std::string bracketed_number(const ProgramText& text, std::size_t begin, std::size_t end) {
  const std::size_t open = text.code().find('[', begin);
  const int number = open < end ? position_number(text, open) : -1;
  return number < 0 ? "" : std::to_string(number);
}

std::size_t closing_bracket(std::string_view code, std::size_t open, std::size_t end) {
  for (int depth = 0; open < end; ++open) {
    depth += code[open] == '[' ? 1 : code[open] == ']' ? -1 : 0;
    if (depth == 0) break;
  }
  return open;
}

bool is_first_group(std::string_view group) {
  const std::string small = lower_case(group);
  const std::string_view number = small.starts_with("gp") ? std::string_view(small).substr(2) : small;
  return !std::all_of(number.begin(), number.end(), is_digit) || number == "1";
}

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

/// "  12:  P[3]=LPOS" and "P[3,2:y]=...", also behind IF; $MNUTOOL[1,3]=.. is what UTOOL[3]=.. is. What stands
/// elsewhere than before the sign is computed with, unless PR[1]=P[3] keeps it.
void find_fanuc_changes(const ProgramText& text, std::size_t begin, std::size_t end, ChangedNames& changes) {
  const std::string_view code = text.code().substr(0, end);
  begin = after_line_number(code, begin);
  if (begin >= end || code[begin] == '!' || code.substr(begin).starts_with("//")) return;  // a remark
  const bool motion = is_fanuc_motion(code, begin);
  std::size_t sign = end;  // of the assignment that has been read
  for (std::size_t at = begin; at < end; ++at) {
    if (code[at] == '=') sign = at;
    if (!text.begins_word(at)) continue;
    const std::string word = text.word_at(at);
    const bool of_group = word == "$mnuframe" || word == "$mnutool", position = word == "p";
    const std::size_t open = text.skip_spaces(text.word_end(at));
    if (!(position || word == "uframe" || word == "utool" || of_group) || open >= end || code[open] != '[') continue;
    const std::size_t close = closing_bracket(code, open, end), next = close < end ? text.skip_spaces(close + 1) : end;
    const auto number = changed_number(code.substr(open + 1, close - open - 1), of_group);
    if (!number) continue;
    const std::string what = position ? word : word.ends_with("tool") ? "utool" : "uframe";
    if (next < end && code[next] == '=') {
      changes.changed(what + '[' + *number + ']', at);
    } else if (position && !motion &&
               !(is_whole_position(text, begin, sign) && is_whole_position(text, sign + 1, end))) {
      changes.used(what + '[' + *number + ']', at);
    }
  }
}

}  // namespace demecal::inline languages
