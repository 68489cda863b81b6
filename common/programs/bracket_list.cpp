#include "programs/bracket_list.hpp"

namespace demecal {
namespace {

constexpr int kDeepestBracket = 20;

class ListReader {
 public:
  ListReader(const ProgramText& text, char opening)
      : text_(text), code_(text.code()), opening_(opening), closing_(opening == '[' ? ']' : '}') {}

  BracketItem list(std::size_t begin, int depth) const {
    if (depth > kDeepestBracket) text_.fail(begin, 1, "is nested too deeply");
    BracketItem whole{begin, 0, true, {}};
    std::size_t at = begin + 1;
    while (true) {
      whole.items.push_back(item(at, depth));
      if (at >= code_.size()) text_.fail(begin, code_.size() - begin, "opens a bracket that is never closed");
      if (code_[at++] == closing_) break;
    }
    whole.size = at - begin;
    if (whole.items.size() == 1 && whole.items.front().size == 0) whole.items.clear();
    return whole;
  }

 private:
  /// The item from `at` up to the comma or bracket after it, where `at` then stands.
  BracketItem item(std::size_t& at, int depth) const {
    at = text_.skip_spaces(at);
    if (at < code_.size() && code_[at] == opening_) {
      BracketItem inner = list(at, depth + 1);
      const std::size_t after = text_.skip_spaces(inner.begin + inner.size);
      if (after >= code_.size() || code_[after] == ',' || code_[after] == closing_) {
        at = after;
        return inner;
      }
    }
    const std::size_t begin = at;
    int parentheses = 0, brackets = 0;
    for (; at < code_.size(); ++at) {
      const char letter = code_[at];
      if (brackets == 0 && (letter == closing_ || (letter == ',' && parentheses <= 0))) break;
      parentheses += letter == '(' ? 1 : letter == ')' ? -1 : 0;
      brackets += letter == opening_ ? 1 : letter == closing_ ? -1 : 0;
    }
    std::size_t first = begin;
    const std::string_view value = text_.trimmed(first, at);
    return {first, value.size(), false, {}};
  }

  const ProgramText& text_;
  std::string_view code_;
  char opening_, closing_;
};

}  // namespace

BracketItem read_list(const ProgramText& text, std::size_t begin, char opening) {
  return ListReader(text, opening).list(begin, 1);
}

}  // namespace demecal
