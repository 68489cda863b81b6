// FANUC .LS: the way through the instructions, and which frame and tool they select on it.
#include <Eigen/Geometry>
#include <algorithm>
#include <cstddef>
#include <string>
#include <string_view>

#include "data/text.hpp"
#include "languages/fanuc_ls_instructions.hpp"
#include "languages/fanuc_ls_motions.hpp"
#include "parsed_programs/compliance.hpp"
#include "parsed_programs/frame_flow.hpp"

namespace demecal::inline languages {

namespace {

/// Whether an instruction that begins with this word, in small letters, is one of the language; otherwise it is the
/// name of a macro, which may do anything. `behind`: what follows.
bool is_fanuc_instruction(std::string_view word, char behind) {
  constexpr std::string_view kWords =
      " if select else endif for endfor jmp lbl call run wait pause abort end timer_overflow override message "
      "error_prog resume_prog maint_prog return_path_dsbl joint_max_speed linear_max_speed uframe_num utool_num "
      "offset tool_offset voffset skip payload col monitor lock unlock weave arc track touch mp force softfloat "
      "follow break point_logic vision torq_limit tc_online independent simultaneous settrig accutrig selbound "
      "stop_tracking search sensor send rcv clr palletizing gp1 gp2 gp3 gp4 gp5 stick diag_rec cancel ";
  const bool motion = word.size() == 1 && std::string_view("jlcas").find(word) != std::string_view::npos;
  return motion || word.starts_with('$') || behind == '=' || behind == '[' ||
         kWords.find(' ' + std::string(word) + ' ') != std::string_view::npos;
}

}  // namespace

/// What tells the way through the instructions, and the frame and tool that they select.
void FanucMotions::read_way(const ProgramText& text, std::size_t begin, std::size_t end) {
  const std::string_view code = text.code().substr(0, end);
  begin = after_line_number(code, begin);
  if (begin >= end || code[begin] == '!' || code.substr(begin).starts_with("//")) return;
  const std::string word = text.begins_word(begin) ? text.word_at(begin) : "";
  const std::string second = text.word_at(text.word_end(begin));
  if ((word == "force" && second == "ctrl") || (word == "softfloat" && second != "end")) compliant_[begin] = word;
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

/// Jumps, and what a motion calls on its way: TB .10sec,CALL WELD.
/// JMP LBL[n], be it behind a condition, and what else goes to labels: TIMEOUT,LBL[n] and, of motions, Skip,LBL[n].
/// That is gone to from where the motion ends; where the skip condition stops it on the way, the next instruction
/// follows.
void FanucMotions::read_jumps(const ProgramText& text, std::size_t begin, std::size_t end) {
  const bool always = text.begins_word(begin) && text.word_at(begin) == "jmp";
  const bool may_stop = is_fanuc_motion(text.code().substr(0, end), begin);
  for (std::size_t at = begin; at < end; ++at) {
    if (!text.begins_word(at)) continue;
    const std::size_t word_end = std::min(text.word_end(at), end);
    if (at > begin && text.word_at(at) == "lbl") {
      way_.jump(may_stop ? at : begin, bracketed_number(text, word_end, end), always);
      if (may_stop) elsewhere_.push_back(at);
    }
    if (may_stop && text.word_at(at) == "call") read_call(text, at, std::min(text.skip_spaces(word_end), end), end);
    at = word_end - 1;
  }
}

/// The program's name, or that of a macro, begins at `name`; what is called may select other frames and tools.
void FanucMotions::read_call(const ProgramText& text, std::size_t begin, std::size_t name, std::size_t end) {
  const std::string_view called = text.code().substr(name, end - name);
  const std::size_t size = begin == name ? called.find_first_of("\r\n(,") : called.find_first_of(" \t\r\n(,");
  std::size_t first = name;
  way_.call(begin, std::string(text.trimmed(first, size == std::string_view::npos ? end : name + size)));
  const KnownFrame selected{"selected", Eigen::Isometry3d::Identity(), "computed"};
  way_.flow().set_tool(begin, selected);
  way_.flow().set_frame(begin, selected);
}

void FanucMotions::read_action(const ProgramText& text, std::size_t begin, std::size_t end, bool conditional) {
  if (begin >= end || !text.begins_word(begin)) return;
  const std::string word = text.word_at(begin);
  const bool tool = word == "utool_num" || word == "$mnutoolnum";
  const bool frame = word == "uframe_num" || word == "$mnuframenum", calls = word == "call";
  std::size_t next = std::min(text.skip_spaces(text.word_end(begin)), end);
  const bool macro = !conditional && !is_fanuc_instruction(word, next < end ? text.code()[next] : ';');
  if (calls || macro) {
    if (conditional) way_.flow().open(begin, FrameFlow::Block::branch);
    read_call(text, begin, macro ? begin : next, end);
    if (conditional) way_.flow().close(begin);
    return;
  }
  if (next < end && text.code()[next] == '[') {
    const std::size_t close = std::min(text.code().find(']', next), end);
    if (!is_first_group(text.code().substr(next + 1, close - next - 1))) return;
    next = std::min(text.skip_spaces(std::min(close + 1, end)), end);
  }
  if (!(tool || frame) || next >= end || text.code()[next] != '=') return;
  std::size_t value = std::min(next + 1, end);
  const std::string_view number = text.trimmed(value, end);
  const bool told = !number.empty() && std::all_of(number.begin(), number.end(), is_digit);
  const KnownFrame selected{"selected", Eigen::Isometry3d::Identity(), told ? std::string(number) : "computed"};
  if (conditional) way_.flow().open(begin, FrameFlow::Block::branch);
  tool ? way_.flow().set_tool(begin, selected) : way_.flow().set_frame(begin, selected);
  if (conditional) way_.flow().close(begin);
}

void FanucMotions::note_way(const ProgramText& text, Program& program) const {
  program.joints_lost_at.insert(program.joints_lost_at.end(), elsewhere_.begin(), elsewhere_.end());
  for (const auto& [begin, word] : compliant_) {
    const bool force = word == "force";
    note_compliance(text, begin, force ? "FORCE CTRL" : "SOFTFLOAT",
                    force ? "where that instruction has ended" : "SOFTFLOAT END", program);
  }
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

}  // namespace demecal::inline languages
