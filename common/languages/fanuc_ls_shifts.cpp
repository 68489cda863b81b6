#include "languages/fanuc_ls_shifts.hpp"

#include <algorithm>
#include <string_view>

#include "data/text.hpp"
#include "languages/fanuc_ls_instructions.hpp"

namespace demecal::inline languages {
namespace {

/// "Touch Offset PR[1]" and "Touch Offset End", "MP Offset PR[1] RPM[1]", "Track TAST[1]" and "Track End": what begins
/// there, and whether it ends; the first is empty where nothing of this kind stands there.
std::pair<std::string, bool> shift_at(const ProgramText& text, const std::string& word, std::size_t begin,
                                      std::size_t end) {
  const auto word_behind = [&](std::size_t at) {
    const std::size_t next = text.skip_spaces(text.word_end(at));
    return next < end && text.begins_word(next) ? next : end;
  };
  const std::size_t second = word_behind(begin);
  if (second >= end) return {};
  if (word == "track") return {"Track", text.word_at(second) == "end"};
  if ((word != "touch" && word != "mp") || text.word_at(second) != "offset") return {};
  const std::size_t third = word_behind(second);
  return {word == "mp" ? "MP Offset" : "Touch Offset", third < end && text.word_at(third) == "end"};
}

std::string either(const std::string& one, const std::string& other) {
  return one.empty() ? other : one;
}

}  // namespace

void FanucShifts::read(const ProgramText& text, std::size_t begin, std::size_t end) {
  const std::string_view code = text.code().substr(0, end);
  begin = after_line_number(code, begin);
  if (begin >= end || !text.begins_word(begin)) return;  // nothing, or a remark
  const std::string word = text.word_at(begin);
  if (const auto [what, ends] = shift_at(text, word, begin, end); !what.empty()) {
    why_ = ends ? ""
                : "a motion to it is shifted by " + what +
                      (what == "Track" ? ", which follows sensors" : ", which is computed") + " when the program runs";
    return;
  }
  read_word(text, word, begin, end);
  for (std::size_t at = begin; at < end; ++at) {
    if (!text.begins_word(at)) continue;
    if (at > begin && text.word_at(at) == "lbl")
      at_jumps_.emplace_back(bracketed_number(text, text.word_end(at), end), why_);
    at = std::min(text.word_end(at), end) - 1;
  }
}

void FanucShifts::read_word(const ProgramText& text, const std::string& word, std::size_t begin, std::size_t end) {
  const std::string_view code = text.code().substr(0, end);
  const bool branch = word == "if" && lower_case(code.substr(begin)).find("then") != std::string::npos;
  if (word == "lbl") at_labels_[bracketed_number(text, begin, end)] = why_;
  if (branch || word == "for") blocks_.push_back(why_);
  const bool other = word == "else" && code.find(',', begin) >= end, closes = word == "endif" || word == "endfor";
  if (blocks_.empty() || !(other || closes)) return;
  if (blocks_.back() != why_) by_blocks_ = either(by_blocks_, either(why_, blocks_.back()));
  if (closes) blocks_.pop_back();
}

std::string FanucShifts::anywhere() const {
  std::string found = by_blocks_;
  for (const auto& [label, why] : at_jumps_) {
    const auto there = at_labels_.find(label);
    const std::string& why_there = there == at_labels_.end() ? why_ : there->second;
    if (why != why_there) found = either(found, either(why, why_there));
  }
  return found.empty() ? "" : "the program jumps or branches, and so it may be that " + found;
}

}  // namespace demecal::inline languages
