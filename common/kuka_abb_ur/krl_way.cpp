// The way that statements of KRL tell through a program: routines, branches, loops, jumps and calls.
#include <algorithm>
#include <array>
#include <cstddef>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "data/text.hpp"
#include "kuka_abb_ur/krl_frames.hpp"
#include "kuka_abb_ur/krl_loads.hpp"
#include "kuka_abb_ur/krl_statements.hpp"
#include "parsed_programs/frame_flow.hpp"
#include "parsed_programs/program_text.hpp"

namespace demecal::inline kuka_abb_ur {

namespace {

bool is_spline(const std::string& word) {
  return word == "spline" || word == "ptp_spline";
}

}  // namespace

/// One statement, as all are that stand in a line.
void KrlFrames::read_line(std::size_t begin, std::size_t end) {
  begin = std::min(text_.skip_spaces(begin), end);
  if (begin >= end || !text_.begins_word(begin)) return;
  std::string word = text_.word_at(begin);
  std::size_t next = std::min(text_.skip_spaces(text_.word_end(begin)), end);
  if (word == "global" && next < end) {
    begin = next;
    word = text_.word_at(begin);
    next = std::min(text_.skip_spaces(text_.word_end(begin)), end);
  }
  if (read_routine(word, begin, next, end)) return;
  const bool deferred = word == "interrupt" || word == "trigger";
  const std::size_t statement = begin;
  const bool moves = points_of_krl_motion(word) > 0 || is_spline(word);
  bool with = false;
  for (std::size_t at = begin; at < end; ++at) {
    if (!text_.begins_word(at)) continue;
    const std::size_t word_end = std::min(text_.word_end(at), end);
    const std::string called = lower_case(text_.code().substr(at, word_end - at));
    const bool opens = text_.next(word_end) == '(' && text_.skip_spaces(word_end) < end;
    if (opens && deferred) flow_.call_at_any_time(called);
    if (opens && !deferred) read_call(called, at, word_end, at == statement);
    with = with || (moves && called == "with");
    if (!with || (called != "$tool" && called != "$base" && called != "$load")) {
      read_statement(at, word_end);
    } else {
      read_with(word, statement, end, at);
    }
    at = word_end - 1;
  }
  read_control(word, end, next);
}

/// SLIN XP1 WITH $TOOL=..: for this motion alone; SPLINE WITH ..: up to ENDSPLINE.
void KrlFrames::read_with(const std::string& word, std::size_t statement, std::size_t end, std::size_t at) {
  const std::string what = text_.word_at(at);
  const std::string all = is_spline(word) ? lower_case(text_.code().substr(end)) : "";
  const std::size_t block = all.find("endspline");
  const std::size_t stop = !is_spline(word) ? end : block == std::string::npos ? text_.code().size() : end + block;
  if (what != "$load") return with_.push_back({statement, stop, what == "$tool"});
  if (small_.empty()) small_ = lower_case(text_.code());
  loads_.push_back({text_.place(at), statement, with_load_kg(small_, text_.word_end(at)), stop});
}

/// DEF and END, and what is no statement.
bool KrlFrames::read_routine(const std::string& word, std::size_t begin, std::size_t next, std::size_t line_end) {
  const std::size_t file = text_.source().file_at(begin);
  if (word == "def" || word == "deffct") {
    const std::size_t open = std::min(text_.code().find('(', next), line_end);
    std::size_t name = open;
    while (name > next && !is_word_letter(text_.code()[name - 1])) --name;
    while (name > next && is_word_letter(text_.code()[name - 1])) --name;
    flow_.begin_routine(begin, text_.word_at(name), file);
  } else if (word == "end" || word == "endfct" || word == "defdat") {
    flow_.begin_routine(begin, "", file);
  } else {
    return word == "decl" || word == "ext" || word == "extfct" || word == "import" || word == "signal";
  }
  return true;
}

/// What tells the way through the statements; `end` of its line, for what is called in a condition comes before.
bool KrlFrames::read_control(const std::string& word, std::size_t end, std::size_t next) {
  using Block = FrameFlow::Block;
  if (word == "if") return flow_.open(end, Block::branch), true;
  if (word == "switch") return flow_.open(end, Block::selection), true;
  if (word == "for" || word == "while") return flow_.open(end, Block::loop), true;
  if (word == "repeat") return flow_.open(end, Block::repeated), true;
  if (word == "loop") return flow_.open(end, Block::endless), true;
  if (word == "else" || word == "default") return flow_.alternative(end, true), true;
  if (word == "case") return flow_.alternative(end, false), true;
  if (word == "exit") return flow_.leave_loop(end), true;
  if (word == "return" || word == "resume") return flow_.leave_routine(end), true;
  if (word == "goto") return flow_.jump(end, text_.word_at(next), true), true;
  constexpr std::array<std::string_view, 6> kEnds{"endif", "endswitch", "endfor", "endwhile", "until", "endloop"};
  if (std::find(kEnds.begin(), kEnds.end(), word) != kEnds.end()) return flow_.close(end), true;
  const bool label = next < text_.code().size() && text_.code()[next] == ':';
  if (label) flow_.label(end, word);
  return label;
}

/// NAME(...); where it is a statement, NAME may be a routine that is not in the files.
void KrlFrames::read_call(const std::string& word, std::size_t begin, std::size_t end, bool statement) {
  constexpr std::array<std::string_view, 17> kOthers{"bas",    "if",    "while",  "for",    "switch", "case",
                                                     "until",  "wait",  "pulse",  "cwrite", "cread",  "copen",
                                                     "cclose", "sread", "swrite", "clear",  "return"};
  const bool part = begin > 0 && (text_.code()[begin - 1] == '.' || text_.code()[begin - 1] == '#');
  if (part || word.starts_with('$') || std::find(kOthers.begin(), kOthers.end(), word) != kOthers.end()) return;
  if (statement) calls_[begin] = std::string(text_.code().substr(begin, end - begin)) + "()";
  flow_.call(begin, word, statement);
}

}  // namespace demecal::inline kuka_abb_ur
