#include "languages/fanuc_ls_motions.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <optional>
#include <string_view>
#include <utility>

#include "data/text.hpp"
#include "parsed_programs/frame_flow.hpp"

namespace demecal::inline languages {
namespace {

const std::string kIncrement = "a motion goes by it and not to it (INC)";
const std::string kTouch = "a motion to it is shifted by Touch Offset, which is computed when the program runs";
const std::string kOffset =
    "a motion to it also names a register or an offset, which is computed when the program runs";

bool is_blank(char letter) {
  return letter == ' ' || letter == '\t' || letter == '\r' || letter == '\n';
}

/// Past the number of a line.
std::size_t after_line_number(std::string_view code, std::size_t begin) {
  while (begin < code.size() && (is_blank(code[begin]) || is_digit(code[begin]) || code[begin] == ':')) ++begin;
  return begin;
}

/// Whether a motion begins there: "L P[3] ...", "J PR[1] ...".
bool is_motion_at(std::string_view code, std::size_t begin) {
  if (begin + 1 >= code.size() || is_word_letter(code[begin + 1])) return false;
  return std::string_view("jJlLcCaA").find(code[begin]) != std::string_view::npos;
}

/// "7" of "[7:up]" that opens at or after `begin`; empty where it is no number.
std::string bracketed_number(const ProgramText& text, std::size_t begin, std::size_t end) {
  const std::size_t open = text.code().find('[', begin);
  const int number = open < end ? position_number(text, open) : -1;
  return number < 0 ? "" : std::to_string(number);
}

/// The bracket that closes the one at `open`; `end` where none does.
std::size_t closing_bracket(std::string_view code, std::size_t open, std::size_t end) {
  for (int depth = 0; open < end; ++open) {
    depth += code[open] == '[' ? 1 : code[open] == ']' ? -1 : 0;
    if (depth == 0) break;
  }
  return open;
}

/// Whether the first group of motion may be meant by "1", "GP1" or anything that is computed.
bool is_first_group(std::string_view group) {
  const std::string small = lower_case(group);
  const std::string_view number = small.starts_with("gp") ? std::string_view(small).substr(2) : small;
  return !std::all_of(number.begin(), number.end(), is_digit) || number == "1";
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

/// "  12:  P[3]=LPOS" and "P[3,2:y]=...", also behind IF; $MNUTOOL[1,3]=.. is what UTOOL[3]=.. is.
void find_changes(const ProgramText& text, std::size_t begin, std::size_t end, ChangedNames& changes) {
  const std::string_view code = text.code().substr(0, end);
  begin = after_line_number(code, begin);
  if (begin < end && code[begin] == '!') return;  // a remark
  for (std::size_t at = begin; at < end; ++at) {
    const std::string word = text.begins_word(at) ? text.word_at(at) : "";
    const bool of_group = word == "$mnuframe" || word == "$mnutool";
    if (word != "p" && word != "uframe" && word != "utool" && !of_group) continue;
    const std::size_t open = text.skip_spaces(text.word_end(at));
    if (open >= end || code[open] != '[') continue;
    const std::size_t close = closing_bracket(code, open, end);
    const std::size_t sign = close < end ? text.skip_spaces(close + 1) : end;
    if (sign >= end || code[sign] != '=') continue;
    const auto number = changed_number(code.substr(open + 1, close - open - 1), of_group);
    const std::string what = word == "p" ? word : word.ends_with("tool") ? "utool" : "uframe";
    if (number) changes.changed(what + '[' + *number + ']', at);
  }
}

}  // namespace

std::size_t fanuc_section(const ProgramText& text, std::string_view heading) {
  const std::string_view code = text.code();
  for (std::size_t begin = 0; begin < code.size();) {
    const std::size_t end = std::min(code.find('\n', begin), code.size());
    std::size_t first = begin;
    if (lower_case(text.trimmed(first, end)) == heading) return end;
    begin = end + 1;
  }
  return code.size();
}

bool tracks_a_line(const ProgramText& text) {
  bool tracks = false;
  text.for_each_word([&](std::size_t begin, std::size_t end) {
    const std::string word = text.word_at(begin);
    if (word == "settrig" || (word == "line" && text.next(end) == '[')) tracks = true;
    if (word != "line_track_schedule_number") return;
    const char number = text.next(text.skip_spaces(end) + 1);  // behind the colon
    tracks = tracks || (number != '0' && number != ';');
  });
  return tracks;
}

bool moves_first_group(const ProgramText& text, std::size_t instructions) {
  bool moves = true;
  text.for_each_word([&](std::size_t begin, std::size_t end) {
    const std::size_t sign = text.skip_spaces(end);
    if (begin >= instructions || text.word_at(begin) != "default_group" || sign >= instructions) return;
    if (text.code()[sign] == '=' && text.next(sign + 1) == '*') moves = false;
  });
  return moves;
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

void FanucMotions::read(const ProgramText& text, std::size_t begin, std::size_t end, ChangedNames& changes) {
  while (begin < end) {
    const std::size_t stop = std::min(text.code().find(';', begin), end);
    read_touch_offset(text, begin, stop);
    read_statement(text, begin, stop);
    find_changes(text, begin, stop, changes);
    read_way(text, begin, stop);
    begin = stop + 1;
  }
  way_.flow().finish();
}

/// What tells the way through the instructions, and the frame and tool that they select.
void FanucMotions::read_way(const ProgramText& text, std::size_t begin, std::size_t end) {
  const std::string_view code = text.code().substr(0, end);
  begin = after_line_number(code, begin);
  if (begin >= end || code[begin] == '!' || code.substr(begin).starts_with("//")) return;
  const std::string word = text.begins_word(begin) ? text.word_at(begin) : "";
  const std::size_t comma = std::min(code.find(',', begin), end);
  read_jumps(text, begin, end);
  if (word == "if" && lower_case(code.substr(begin)).find("then") != std::string::npos)
    return way_.flow().open(begin, FrameFlow::Block::branch);
  if (word == "else" && comma >= end) return way_.flow().alternative(begin, true);
  if (word == "for") return way_.flow().open(begin, FrameFlow::Block::loop);
  if (word == "endif" || word == "endfor") return way_.flow().close(begin);
  if (word == "end" || word == "abort") return way_.flow().leave_routine(begin);
  if (word == "lbl") return way_.label(begin, bracketed_number(text, begin, end));
  const bool conditional = word == "if" || word == "select" || word == "else" || code[begin] == '=';
  const std::size_t action = conditional ? std::min(comma + 1, end) : begin;
  read_action(text, std::min(text.skip_spaces(action), end), end, conditional);
}

/// JMP LBL[n], be it behind a condition, and what else goes to labels: TIMEOUT,LBL[n] and, of motions, Skip,LBL[n].
/// That is gone to from where the motion ends; where the skip condition stops it on the way, the next instruction
/// follows.
void FanucMotions::read_jumps(const ProgramText& text, std::size_t begin, std::size_t end) {
  const bool always = text.begins_word(begin) && text.word_at(begin) == "jmp";
  const bool may_stop = is_motion_at(text.code().substr(0, end), begin);
  for (std::size_t at = begin; at < end; ++at) {
    if (!text.begins_word(at)) continue;
    const std::size_t word_end = std::min(text.word_end(at), end);
    if (at > begin && text.word_at(at) == "lbl") {
      way_.jump(may_stop ? at : begin, bracketed_number(text, word_end, end), always);
      if (may_stop) elsewhere_.push_back(at);
    }
    at = word_end - 1;
  }
}

void FanucMotions::read_action(const ProgramText& text, std::size_t begin, std::size_t end, bool conditional) {
  if (begin >= end || !text.begins_word(begin)) return;
  const std::string word = text.word_at(begin);
  const bool tool = word == "utool_num" || word == "$mnutoolnum";
  const bool frame = word == "uframe_num" || word == "$mnuframenum", calls = word == "call";
  std::size_t next = std::min(text.skip_spaces(text.word_end(begin)), end);
  if (!calls && next < end && text.code()[next] == '[') {
    const std::size_t close = std::min(text.code().find(']', next), end);
    if (!is_first_group(text.code().substr(next + 1, close - next - 1))) return;
    next = std::min(text.skip_spaces(std::min(close + 1, end)), end);
  }
  if (!calls && (!(tool || frame) || next >= end || text.code()[next] != '=')) return;
  std::size_t value = std::min(next + 1, end);
  const std::string_view number = text.trimmed(value, end);
  const bool told = !calls && !number.empty() && std::all_of(number.begin(), number.end(), is_digit);
  const KnownFrame selected{"selected", Eigen::Isometry3d::Identity(), told ? std::string(number) : "computed"};
  if (conditional) way_.flow().open(begin, FrameFlow::Block::branch);
  if (calls) {
    const std::size_t stop = std::min(text.code().find_first_of(" \t\r\n(,", next), end);
    way_.call(begin, std::string(text.code().substr(next, stop - next)));
  }
  if (tool || calls) way_.flow().set_tool(begin, selected);  // what is called may select others
  if (frame || calls) way_.flow().set_frame(begin, selected);
  if (conditional) way_.flow().close(begin);
}

void FanucMotions::note_way(const ProgramText& text, Program& program) const {
  program.joints_lost_at.insert(program.joints_lost_at.end(), elsewhere_.begin(), elsewhere_.end());
  way_.note_arrivals(text, program);
}

std::string FanucMotions::stopped_by(const ProgramText& text, int number, const std::string& frame,
                                     const std::string& tool) const {
  const auto found = uses_.find(number);
  if (found == uses_.end() || way_.jumps_anywhere()) return "";
  const auto differs = [](const std::string& selected, const std::string& own) {
    const auto is_number = [](const std::string& word) {
      return !word.empty() && std::all_of(word.begin(), word.end(), is_digit);
    };
    return is_number(selected) && is_number(own) && selected != own;
  };
  for (const TargetUse& use : found->second) {
    const StatedFrames selected = way_.flow().at(use.begin).frames;
    const bool other_frame = differs(selected.unknown_frame, frame), other_tool = differs(selected.unknown_tool, tool);
    if (!other_frame && !other_tool) continue;
    return "line " + std::to_string(text.place(use.begin).line) + " moves to it with " +
           (other_frame ? "UFRAME_NUM=" + selected.unknown_frame + ", and its UF is " + frame
                        : "UTOOL_NUM=" + selected.unknown_tool + ", and its UT is " + tool) +
           ": the controller stops there with an error";
  }
  return "";
}

/// "  12:L P[3] 100mm/sec FINE INC", its line number and line breaks included.
void FanucMotions::read_statement(const ProgramText& text, std::size_t begin, std::size_t end) {
  const std::string_view code = text.code().substr(0, end);
  begin = after_line_number(code, begin);
  if (!is_motion_at(code, begin)) return;
  const bool line = code[begin] != 'j' && code[begin] != 'J';
  std::vector<int> numbers;
  std::string why = shifted_ ? kTouch : "";
  bool of_register = false, wrist_by_joints = false;
  for (std::size_t at = begin + 1; at < end; ++at) {
    if (!text.begins_word(at)) continue;
    const std::size_t word_end = std::min(text.word_end(at), end);
    const std::string word = lower_case(code.substr(at, word_end - at));
    const bool indexed = text.next(word_end) == '[' && text.skip_spaces(word_end) < end;
    if (word == "p" && indexed) numbers.push_back(position_number(text, text.skip_spaces(word_end)));
    if (word == "inc") why = kIncrement;
    if (word == "search" && indexed) elsewhere_.push_back(at);  // Search[-Z] stops where it touches
    if (indexed && (word == "pr" || word == "vr")) {
      const std::size_t close = closing_bracket(code, text.skip_spaces(word_end), end);
      of_register = of_register || text.next(std::min(close + 1, end)) != '=';  // Skip,LBL[1],PR[2]=LPOS fills it
    }
    wrist_by_joints = wrist_by_joints || word == "wjnt";
    if (why.empty() && (of_register || word.ends_with("offset"))) why = kOffset;
    at = word_end - 1;
  }
  if (numbers.empty()) {
    std::size_t goal = std::min(begin + 1, end);
    const std::string_view rest = text.trimmed(goal, end);
    others_[begin] = of_register ? "" : rest.substr(0, rest.find_first_of(" \t\r\n"));
  }
  const bool indirect = std::any_of(numbers.begin(), numbers.end(), [](int number) { return number < 0; });
  if (!why.empty() || indirect || numbers.empty()) elsewhere_.push_back(begin);
  for (const int number : numbers) {
    if (number < 0 && !why.empty()) computed_numbers_ = "a motion may go by it: " + why;
    if (number >= 0 && !why.empty()) not_sent_to_[number] = why;
    way_.motion(begin);
    if (number >= 0) uses_[number].push_back({begin, line && !wrist_by_joints ? Motion::line : Motion::joints, {}});
  }
}

/// From Touch Offset PR[n] to Touch Offset End motions are shifted.
void FanucMotions::read_touch_offset(const ProgramText& text, std::size_t begin, std::size_t end) {
  begin = after_line_number(text.code().substr(0, end), begin);
  if (begin >= end || !text.begins_word(begin) || text.word_at(begin) != "touch") return;
  const std::size_t offset = text.skip_spaces(text.word_end(begin));
  if (offset < end && text.word_at(offset) == "offset") shifted_ = text.word_at(text.word_end(offset)) != "end";
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
