#include "kuka_abb_ur/rapid_way.hpp"

#include <algorithm>
#include <set>
#include <string_view>

namespace demecal::inline kuka_abb_ur {

bool RapidWay::begins_line(std::size_t begin) const {
  const std::string_view before = text_.code().substr(0, begin);
  const std::size_t last = before.find_last_not_of(" \t\r");
  return last == std::string_view::npos || before[last] == '\n';
}

/// IF ... THEN ... ENDIF, or IF ... and one statement.
void RapidWay::read_if(std::size_t begin) {
  const std::size_t stop = std::min(text_.code().find(';', begin), text_.code().size());
  std::size_t at = begin;
  while (at < stop && !(text_.begins_word(at) && text_.word_at(at) == "then")) ++at;
  flow_.open(begin, FrameFlow::Block::branch);
  if (at >= stop) only_statement_ = stop;
}

void RapidWay::read_word(std::size_t begin, const std::string& word) {
  using Block = FrameFlow::Block;
  if (only_statement_ && begin >= *only_statement_) {
    flow_.close(*only_statement_);
    only_statement_.reset();
  }
  const std::size_t end = text_.word_end(begin);
  if (word == "if") return read_if(begin);
  const bool always = text_.word_at(end) == "true" && text_.word_at(text_.word_end(text_.skip_spaces(end))) == "do";
  if (word == "while") return flow_.open(begin, always ? Block::endless : Block::loop);
  if (word == "for") return flow_.open(begin, Block::loop);
  if (word == "test") return flow_.open(begin, Block::selection);
  if (word == "elseif" || word == "case") return flow_.alternative(begin, false);
  if (word == "else" || word == "default") return flow_.alternative(begin, true);
  if (word == "endif" || word == "endwhile" || word == "endfor" || word == "endtest") return flow_.close(begin);
  if (word == "return" || word == "exit") return flow_.leave_routine(begin);
  if (word == "goto") return flow_.jump(begin, text_.word_at(end), true);
  if (!begins_line(begin)) return;
  if (word == "error" || word == "undo") return flow_.begin_routine(begin, "", text_.source().file_at(begin));
  const std::size_t colon = text_.skip_spaces(end);
  if (text_.next(end) == ':' && !text_.code().substr(colon).starts_with(":=")) flow_.label(begin, word);
}

void end_at_rapid_routines(const ProgramText& text, Program& program) {
  const auto name_after = [&](const std::string& word, std::size_t end) -> std::size_t {
    const std::size_t next = text.skip_spaces(end);
    if (word == "proc" || word == "trap") return next;
    return word == "func" ? text.skip_spaces(text.word_end(next)) : 0;  // behind its type
  };
  const auto for_each = [&](const auto& visit) {
    text.for_each_word([&](std::size_t begin, std::size_t end) {
      const std::string word = text.word_at(begin);
      visit(begin, word, name_after(word, end));
    });
  };
  std::set<std::string> routines;
  for_each([&](std::size_t /*begin*/, const std::string& /*word*/, std::size_t name) {
    if (name != 0) routines.insert(text.word_at(name));
  });
  FrameFlow flow("", "");
  RapidWay way(text, flow);
  std::size_t own = 0;
  for_each([&](std::size_t begin, const std::string& word, std::size_t name) {
    if (name != 0) flow.begin_routine(begin, text.word_at(own = name), text.source().file_at(begin));
    if (begin != own && routines.contains(word)) flow.call(begin, word, false);
    if (name == 0 && begin != own) way.read_word(begin, word);
  });
  flow.finish();
  flow.note_arrivals(program);
}

}  // namespace demecal::inline kuka_abb_ur
