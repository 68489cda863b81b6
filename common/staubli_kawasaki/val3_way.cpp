#include "staubli_kawasaki/val3_way.hpp"

#include <algorithm>
#include <string>
#include <string_view>

#include "data/text.hpp"

namespace demecal::inline staubli_kawasaki {

void Val3Way::read(const ProgramText& code, const Val3Code& program, std::size_t file) {
  flow_.begin_routine(program.begin, lower_case(program.name), file);
  for (std::size_t at = program.begin; at < program.end; ++at) {
    if (!code.begins_word(at)) continue;
    if (at == program.begin || code.code()[at - 1] != '.') read_word(code, at);
    at = code.word_end(at) - 1;
  }
}

void Val3Way::read_word(const ProgramText& code, std::size_t begin) {
  using Block = FrameFlow::Block;
  const std::string word = code.word_at(begin);
  if (word == "if") return flow_.open(begin, Block::branch);
  if (word == "switch") return flow_.open(begin, Block::selection);
  if (word == "for" || word == "while") return flow_.open(begin, Block::loop);
  if (word == "do") return flow_.open(begin, Block::repeated);
  if (word == "else" || word == "default") return flow_.alternative(begin, true);
  if (word == "elseif" || word == "case") return flow_.alternative(begin, false);
  if (word == "endif" || word == "endswitch" || word == "endfor" || word == "endwhile" || word == "until")
    return flow_.close(begin);
  if (word == "return") return flow_.leave_routine(begin);
  if (word == "stopmove" || word == "resetmotion") stops_.push_back(begin);
  if (word != "call") return;
  const std::size_t name = code.skip_spaces(code.word_end(begin));
  const std::size_t stop = std::min(code.code().find_first_of("( \t\r\n", name), code.code().size());
  flow_.call(begin, lower_case(code.code().substr(name, stop - name)), true);
}

void Val3Way::note_arrivals(Program& program) const {
  program.joints_lost_at.insert(program.joints_lost_at.end(), stops_.begin(), stops_.end());
  flow_.note_arrivals(program);
}

}  // namespace demecal::inline staubli_kawasaki
