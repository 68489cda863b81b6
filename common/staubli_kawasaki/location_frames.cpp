#include "staubli_kawasaki/location_frames.hpp"

#include <algorithm>
#include <array>
#include <optional>
#include <string_view>

#include "data/text.hpp"
#include "staubli_kawasaki/location_names.hpp"

namespace demecal::inline staubli_kawasaki {
namespace {

/// Instructions behind which the arm stands where no location says.
bool moves_untold(const std::string& word) {
  constexpr std::array<std::string_view, 8> kWords{"drive", "draw", "tdraw", "home", "home2", "align", "ready", "nest"};
  return std::find(kWords.begin(), kWords.end(), word) != kWords.end();
}

LocationFrames::Word word_of(const std::string& unknown) {
  const bool reason = unknown.find(' ') != std::string::npos;
  return {reason ? "" : unknown, reason ? unknown : ""};
}

}  // namespace

std::string program_name(const ProgramText& text, std::size_t begin) {
  const std::string_view code = text.code();
  std::size_t end = begin;
  while (end < code.size() && (is_word_letter(code[end]) || code[end] == '.')) ++end;
  return lower_case(code.substr(begin, end - begin));
}

bool moves_or_tells_anew(const std::string& word) {
  return moves_untold(word) || word == "tool" || word == "base" || word == "point" || word == "set" || word == "here";
}

void LocationFrames::begin_program(const ProgramText& text, std::size_t at, const std::string& name) {
  flow_.begin_routine(at, name, text.source().file_at(at));
}

void LocationFrames::read_line(const ProgramText& text, std::size_t begin, std::size_t end) {
  begin = std::min(text.skip_spaces(begin), end);
  std::size_t digits = begin;
  while (digits < end && is_digit(text.code()[digits])) ++digits;
  if (digits > begin) flow_.label(begin, std::string(text.code().substr(begin, digits - begin)));
  begin = std::min(text.skip_spaces(digits), end);
  if (begin < end && text.begins_word(begin)) read_way(text, text.word_at(begin), begin, end);
}

void LocationFrames::read_way(const ProgramText& text, const std::string& word, std::size_t begin, std::size_t end) {
  using Block = FrameFlow::Block;
  if (moves_untold(word)) untold_[begin] = word;
  if (word == "if" && find_word(text, begin, end, "then") < end) return flow_.open(begin, Block::branch);
  if (word == "case" || word == "scase") return flow_.open(begin, Block::selection);
  const std::size_t condition = text.skip_spaces(text.word_end(begin));
  const bool always = text.word_at(condition) == "true" && text.word_at(text.word_end(condition)) == "do";
  if (word == "while" && always) return flow_.open(begin, Block::endless);
  if (word == "while" || word == "for") return flow_.open(begin, Block::loop);
  if (word == "do") return flow_.open(begin, Block::repeated);
  if (word == "else" || word == "any") return flow_.alternative(begin, true);
  if (word == "value" || word == "svalue" || word == "elseif") return flow_.alternative(begin, false);
  if (word == "end" || word == "until") return flow_.close(begin);
  if (word == "exit") return flow_.leave_loop(begin);
  if (word == "return") return flow_.leave_routine(begin);
  const std::size_t to = find_word(text, begin, end, "goto"), called = find_word(text, begin, end, "call");
  if (to < end) {
    const bool conditional = find_word(text, begin, end, "if") < end;
    return flow_.jump(begin, program_name(text, text.skip_spaces(text.word_end(to))), !conditional);
  }
  const bool reacts = word.starts_with("react") || word == "on" || word == "oni" || word == "onenab";
  if (word == "pcexecute") {
    const std::size_t colon = std::min(text.code().find(':', begin), end);
    const std::size_t name = colon < end ? colon + 1 : text.word_end(begin);
    return flow_.call_at_any_time(program_name(text, text.skip_spaces(name)));
  }
  if (reacts) {
    const std::size_t comma = std::min(text.code().find(',', begin), end);
    const std::size_t name = called < end ? text.word_end(called) : std::min(comma + 1, end);
    return flow_.call_at_any_time(program_name(text, text.skip_spaces(name)));
  }
  if (word == "scall") return computed_call(text, begin, end);
  if (called < end) call(text, called, text.skip_spaces(text.word_end(called)));
}

void LocationFrames::call(const ProgramText& text, std::size_t at, std::size_t name) {
  const std::string called = program_name(text, name);
  if (called.empty()) return;
  calls_[at] = std::string(text.code().substr(name, called.size()));
  flow_.call(at, called, true);
}

/// SCALL $name: which program it calls is known when it runs.
void LocationFrames::computed_call(const ProgramText& text, std::size_t at, std::size_t end) {
  calls_[at] = std::string(text.trimmed(at, end));
  flow_.call(at, "scall", true);
}

LocationFrames::Words LocationFrames::at(std::size_t offset, bool of_pose) {
  const FrameFlow::Held held = flow_.at(offset);
  believed_ = believed_ || (of_pose && held.call);
  return {word_of(held.frames.unknown_tool), word_of(held.frames.unknown_frame)};
}

void LocationFrames::note_routines(const ProgramText& text, Program& program) const {
  for (const auto& [at, word] : untold_) {
    note_unknown_motion(program, at, {.name = "", .place = text.place(at)},
                        "the motion of " + word + " goes to no location of this program");
  }
  flow_.note_arrivals(program);
  if (believed_) note_calls_elsewhere(text, flow_.calls_elsewhere(), calls_, program);
}

}  // namespace demecal::inline staubli_kawasaki
