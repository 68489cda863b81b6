#include "languages/yaskawa_jbi_way.hpp"

#include <algorithm>
#include <array>
#include <string>
#include <string_view>

#include "data/text.hpp"
#include "parsed_programs/frame_flow.hpp"

namespace demecal::inline languages {
namespace {

/// "CALL JOB:PICK IF IN#(1)=ON".
bool has_condition(const ProgramText& text, std::size_t begin, std::size_t end) {
  bool found = false;
  for (std::size_t at = begin; at < end; ++at) {
    if (!text.begins_word(at)) continue;
    found = found || text.word_at(at) == "if";
    at = std::max(text.word_end(at), at + 1) - 1;
  }
  return found;
}

/// The argument behind the instruction's word, up to the next blank.
std::string argument_of(const ProgramText& text, std::size_t begin, std::size_t end) {
  const std::size_t first = std::min(text.skip_spaces(text.word_end(begin)), end);
  return std::string(text.code().substr(first, std::min(text.code().find_first_of(" \t", first), end) - first));
}

/// A label's name; empty where `argument` computes it.
std::string label_name(const std::string& argument) {
  return argument.starts_with('*') ? lower_case(argument) : "";
}

bool names_a_job(const std::string& argument) {
  const std::string small = lower_case(argument);
  return small.starts_with("job:") || small.starts_with("ijob");
}

/// Of the language's own instructions, as far as none of the above takes them; others are macros, which may do
/// anything.
bool is_instruction(std::string_view word) {
  constexpr std::string_view kWords =
      " nop end ret call jump pause abort msg cls print setualm timer wait cwait dout din pulse aout aration aratiof "
      "movj movl movc movs imov eimovl smovl smovc smovj refp speed advinit advstop pstart twait tsync dialog "
      "clear inc dec set sete gete gets sqrt sin cos atan mulmat invmat setfile getfile setreg getreg getpos cnvrt "
      "mframe settool add sub mul div and or not xor val asc chr mid len cat getname getdate sfton sftof mshift "
      "comarcon comarcof arcon arcof arcset arccts arccte wvon wvof vwon vwof svspot svguncl gunchg toolon toolof "
      "hsen shckset shckrst systart syend endif endswitch endwhile next else elseif elseifexp case default ifthen "
      "ifthenexp while whileexp for switch ";
  return kWords.find(' ' + std::string(word) + ' ') != std::string_view::npos;
}

/// Of words that are not known: whether the way may part or come together there.
bool may_branch(std::string_view word) {
  constexpr std::array<std::string_view, 9> kStems{"if",     "else", "end",  "while", "for",
                                                   "switch", "case", "loop", "until"};
  return std::ranges::any_of(kStems, [&](std::string_view stem) { return word.starts_with(stem); });
}

void read_job_jump(const ProgramText& text, std::size_t begin, std::size_t end, LabelledWay& way) {
  const std::string to = argument_of(text, begin, end);
  const bool always = !has_condition(text, begin, end);
  if (!names_a_job(to)) return way.jump(begin, label_name(to), always);
  if (always) way.flow().leave_routine(begin);
}

void read_job_call(const ProgramText& text, std::size_t begin, std::size_t end, LabelledWay& way) {
  std::string name = argument_of(text, begin, end);
  if (lower_case(name).starts_with("job:")) name.erase(0, 4);
  if (!name.empty()) way.call(begin, name);
}

}  // namespace

void read_job_way(const ProgramText& text, std::size_t begin, std::size_t end, LabelledWay& way) {
  using Block = FrameFlow::Block;
  if (begin >= end) return;
  if (text.code()[begin] == '*') {
    const std::size_t stop = std::min(text.code().find_first_of(" \t", begin), end);
    return way.label(begin, lower_case(text.code().substr(begin, stop - begin)));
  }
  if (!text.begins_word(begin)) return;
  const std::string word = text.word_at(begin);
  FrameFlow& flow = way.flow();
  if (word == "ifthen" || word == "ifthenexp") return flow.open(begin, Block::branch);
  if (word == "switch") return flow.open(begin, Block::selection);
  if (word == "while" || word == "whileexp" || word == "for") return flow.open(begin, Block::loop);
  if (word == "else" || word == "default") return flow.alternative(begin, true);
  if (word == "elseif" || word == "elseifexp" || word == "case") return flow.alternative(begin, false);
  if (word == "endif" || word == "endswitch" || word == "endwhile" || word == "next") return flow.close(begin);
  if ((word == "end" || word == "ret") && !has_condition(text, begin, end)) return flow.leave_routine(begin);
  if (word == "jump") return read_job_jump(text, begin, end, way);
  if (word == "call") return read_job_call(text, begin, end, way);
  if (is_instruction(word)) return;
  if (may_branch(word)) return way.lose(begin);
  way.call(begin, std::string(text.code().substr(begin, text.word_end(begin) - begin)));
}

bool names_computed_position(const ProgramText& text, std::size_t begin, std::size_t end) {
  const std::string argument = lower_case(argument_of(text, begin, end));
  return argument.starts_with("p[") || argument.starts_with("px[");
}

bool job_jumps(const ProgramText& text) {
  constexpr std::array<std::string_view, 8> kWords{"jump",  "ifthen",   "ifthenexp", "call",
                                                   "while", "whileexp", "switch",    "for"};
  bool jumps = false;
  text.for_each_word([&](std::size_t begin, std::size_t /*end*/) {
    jumps = jumps || std::find(kWords.begin(), kWords.end(), text.word_at(begin)) != kWords.end();
  });
  return jumps;
}

std::pair<std::string, std::string> job_shift(std::string_view word) {
  if (word == "sfton") return {"sftof", "it is moved to while a shift is on (SFTON)"};
  if (word == "comarcon") return {"comarcof", "it is moved to while an arc sensor shifts motions (COMARCON)"};
  return {};
}

std::map<std::string, std::string> all_job_shifts(const ProgramText& text) {
  std::map<std::string, std::string> all;
  text.for_each_word([&](std::size_t begin, std::size_t /*end*/) {
    if (const auto [ending, why] = job_shift(text.word_at(begin)); !ending.empty()) all[ending] = why;
  });
  return all;
}

}  // namespace demecal::inline languages
