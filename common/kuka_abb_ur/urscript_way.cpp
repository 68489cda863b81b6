#include "kuka_abb_ur/urscript_way.hpp"

#include <algorithm>
#include <array>
#include <optional>
#include <string>

#include "kuka_abb_ur/urscript_statements.hpp"
#include "parsed_programs/compliance.hpp"

namespace demecal::inline kuka_abb_ur {
namespace {

/// What the language itself has before a parenthesis; none but set_tcp() changes the tool.
bool is_of_the_language(const std::string& word) {
  static const std::string kWords =
      " acos and asin assert atan atan2 binary_list_to_integer ceil conveyor_pulse_decode cos d2r "
      "enable_external_ft_sensor encoder_enable_pulse_decode encoder_enable_set_tick_count "
      "encoder_set_tick_count end_force_mode end_freedrive_mode end_screw_driving end_teach_mode "
      "enter_critical exit_critical exp floor force force_mode force_mode_set_damping "
      "force_mode_set_gain_scaling freedrive_mode ft_rtde_input_enable integer_to_binary_list "
      "interpolate_pose inv join kill length log make_list modbus_add_signal modbus_delete_signal "
      "modbus_send_custom_command modbus_set_output_register modbus_set_output_signal "
      "modbus_set_runstate_dependent_choice modbus_set_signal_update_frequency movec movej movel movep "
      "norm not optimovej optimovel path_offset_disable path_offset_enable path_offset_set point_dist "
      "popup position_deviation_warning pow powerdown protective_stop r2d random reset_revolution_counter "
      "return rpc_factory rtde_set_watchdog run screw_driving servoc servoj set_analog_out "
      "set_configurable_digital_out set_digital_out set_gravity set_payload set_payload_cog "
      "set_payload_mass set_standard_analog_out set_standard_digital_out set_target_payload set_tcp "
      "set_tool_digital_out set_tool_voltage sin size sleep socket_close socket_open socket_send_line "
      "socket_send_string socket_set_var speedj speedl sqrt stop_conveyor_tracking stopj stopl struct sync "
      "tan teach_mode textmsg time tool_contact tool_contact_examples track_conveyor_circular "
      "track_conveyor_linear transpose wrench_trans write_output_boolean_register "
      "write_output_float_register write_output_integer_register xor zero_ftsensor ";
  constexpr std::array<std::string_view, 9> kFamilies{"get_",    "is_",  "modbus_", "pose_", "read_",
                                                      "socket_", "str_", "to_",     "rtde_"};
  return kWords.find(' ' + word + ' ') != std::string::npos ||
         std::ranges::any_of(kFamilies, [&](std::string_view family) { return word.starts_with(family); });
}

/// Statements behind which the arm stands where no target says.
bool is_untold_motion(const std::string& word) {
  constexpr std::array<std::string_view, 7> kWords{
      "speedj", "speedl", "freedrive_mode", "force_mode", "teach_mode", "screw_driving", "run"};
  return std::find(kWords.begin(), kWords.end(), word) != kWords.end();
}

}  // namespace

UrScriptWay::UrScriptWay(const ProgramText& text) : text_(text) {}

std::string UrScriptWay::word_before(std::size_t begin) const {
  const std::string_view code = text_.code();
  const std::size_t last = begin == 0 ? std::string_view::npos : code.find_last_not_of(" \t", begin - 1);
  if (last == std::string_view::npos || !is_word_letter(code[last])) return {};
  std::size_t first = last;
  while (first > 0 && is_word_letter(code[first - 1])) --first;
  return std::string(code.substr(first, last + 1 - first));
}

void UrScriptWay::read_word(std::size_t begin, std::size_t end) {
  if (begin < read_up_to_) return;
  const std::string word(text_.code().substr(begin, end - begin));
  if (word == "track_conveyor_linear" || word == "track_conveyor_circular" || word == "path_offset_enable")
    displaces_ = word;
  if (is_untold_motion(word)) untold_.push_back(begin);
  if (read_control(word, begin, end) || text_.next(end) != '(') return;
  const std::string before = word_before(begin);
  if (before == "def" || before == "thread" || before == "sec") return;
  if (before == "run") return flow_.call_at_any_time(word);
  read_call(begin, end);
}

bool UrScriptWay::read_control(std::string_view word, std::size_t begin, std::size_t end) {
  using Block = FrameFlow::Block;
  if (word == "def" || word == "thread" || word == "sec") {
    const std::size_t name = text_.skip_spaces(end);
    open_.push_back(true);
    flow_.open_routine(begin, std::string(text_.code().substr(name, text_.word_end(name) - name)),
                       text_.source().file_at(begin));
  } else if (word == "if" || word == "while" || word == "elif") {
    if (word != "elif") open_.push_back(false);
    const bool always = text_.word_at(end) == "true" && text_.next(text_.word_end(text_.skip_spaces(end))) == ':';
    if (word == "while") flow_.open(begin, always ? Block::endless : Block::loop);
    if (word == "elif") flow_.alternative(begin, false);
    const std::size_t colon = expression_end(end, ':');
    read_calls(end, colon);
    word == "if" ? flow_.open(colon, Block::branch) : flow_.condition_ends(colon);
    read_up_to_ = colon;
  } else if (word == "else") {
    flow_.alternative(begin, true);
  } else if (word == "return") {
    const std::size_t stop = expression_end(end, '\n');
    read_calls(end, stop);
    flow_.leave_routine(std::max(begin, stop - 1));
    read_up_to_ = stop;
  } else if (word == "halt") {
    flow_.leave_routine(begin);
  } else if (word == "break") {
    flow_.leave_loop(begin);
  } else if (word == "continue") {
    flow_.repeat_loop(begin);
  } else if (word == "end") {
    if (open_.empty()) return true;
    open_.back() ? flow_.close_routine(begin) : flow_.close(begin);
    open_.pop_back();
  } else {
    return false;
  }
  return true;
}

/// Where the expression that begins at `begin` ends: at the sign, a line's end or a word that ends a block, outside of
/// parentheses.
std::size_t UrScriptWay::expression_end(std::size_t begin, char sign) const {
  const std::string_view code = text_.code();
  int depth = 0;
  for (std::size_t at = begin; at < code.size(); ++at) {
    const char letter = code[at];
    depth += letter == '(' || letter == '[' ? 1 : letter == ')' || letter == ']' ? -1 : 0;
    if (depth > 0) continue;
    if (letter == sign || letter == '\n') return at;
    if (!text_.begins_word(at)) continue;
    const std::string word = text_.word_at(at);
    if (word == "end" || word == "else" || word == "elif") return at;
    at = text_.word_end(at) - 1;
  }
  return code.size();
}

/// Those of an expression, the inner ones first.
void UrScriptWay::read_calls(std::size_t begin, std::size_t end) {
  for (; begin < end; ++begin) {
    if (!text_.begins_word(begin)) continue;
    const std::size_t word_end = text_.word_end(begin);
    if (text_.next(word_end) == '(') {
      read_call(begin, word_end);
      begin = std::max(begin, read_up_to_);
    } else {
      begin = word_end - 1;
    }
  }
}

/// NAME(...), made behind what its arguments call; NAME may be a function that is not in the files, but no part of
/// something else.
void UrScriptWay::read_call(std::size_t begin, std::size_t end) {
  const std::string name(text_.code().substr(begin, end - begin));
  const std::size_t open = text_.skip_spaces(end), close = urscript_close(text_, open).value_or(open);
  read_calls(open + 1, close);
  const bool part = begin > 0 && text_.code()[begin - 1] == '.';
  const bool may_be_elsewhere = !part && !is_of_the_language(name);
  if (may_be_elsewhere) calls_[close] = name + "()";
  flow_.call(close, name, may_be_elsewhere);
  read_up_to_ = close;
}

StatedFrames UrScriptWay::held(std::size_t begin, bool by_pose) {
  const FrameFlow::Held found = flow_.at(begin);
  if (found.call && by_pose) believed_.insert(*found.call);
  return found.frames;
}

void UrScriptWay::note_routines(Program& program) const {
  program.joints_lost_at.insert(program.joints_lost_at.end(), untold_.begin(), untold_.end());
  for (const std::size_t begin : untold_) {
    if (text_.word_at(begin) == "force_mode")
      note_compliance(text_, begin, "force_mode()", "end_force_mode()", program);
  }
  flow_.note_arrivals(program);
  if (!believed_.empty())
    note_calls_elsewhere(text_, flow_.calls_elsewhere(), calls_, program, "put what they do into this file");
}

}  // namespace demecal::inline kuka_abb_ur
