#include "kuka_abb_ur/urscript_way.hpp"

#include <algorithm>
#include <string>

namespace demecal::inline kuka_abb_ur {
namespace {

/// What the language itself can do as a statement; none but set_tcp() changes the tool.
bool is_of_the_language(const std::string& word) {
  static const std::string kWords =
      " assert conveyor_pulse_decode enable_external_ft_sensor encoder_enable_pulse_decode "
      "encoder_enable_set_tick_count encoder_set_tick_count end_force_mode end_freedrive_mode "
      "end_screw_driving end_teach_mode enter_critical exit_critical force_mode force_mode_set_damping "
      "force_mode_set_gain_scaling freedrive_mode ft_rtde_input_enable modbus_add_signal "
      "modbus_delete_signal modbus_send_custom_command modbus_set_output_register modbus_set_output_signal "
      "modbus_set_runstate_dependent_choice modbus_set_signal_update_frequency movec movej movel movep "
      "path_offset_disable path_offset_enable path_offset_set popup position_deviation_warning powerdown "
      "protective_stop reset_revolution_counter rtde_set_watchdog screw_driving servoc servoj "
      "set_analog_out set_configurable_digital_out set_digital_out set_gravity set_payload set_payload_cog "
      "set_payload_mass set_standard_analog_out set_standard_digital_out set_target_payload set_tcp "
      "set_tool_digital_out set_tool_voltage sleep socket_close socket_open socket_send_line "
      "socket_send_string socket_set_var speedj speedl stop_conveyor_tracking stopj stopl sync teach_mode "
      "textmsg track_conveyor_circular track_conveyor_linear write_output_boolean_register "
      "write_output_float_register write_output_integer_register zero_ftsensor ";
  return kWords.find(' ' + word + ' ') != std::string::npos;
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
  const std::string word(text_.code().substr(begin, end - begin));
  if (read_control(word, begin, end) || text_.next(end) != '(') return;
  const std::string before = word_before(begin);
  if (before == "def" || before == "thread" || before == "sec") return;
  if (before == "run") return flow_.call_at_any_time(word);
  read_call(word, begin);
}

bool UrScriptWay::read_control(std::string_view word, std::size_t begin, std::size_t end) {
  using Block = FrameFlow::Block;
  const auto open = [&](Block kind) {
    open_.push_back(false);
    flow_.open(begin, kind);
  };
  if (word == "def" || word == "thread" || word == "sec") {
    const std::size_t name = text_.skip_spaces(end);
    open_.push_back(true);
    flow_.open_routine(begin, std::string(text_.code().substr(name, text_.word_end(name) - name)),
                       text_.source().file_at(begin));
  } else if (word == "if") {
    open(Block::branch);
  } else if (word == "while") {
    open(Block::loop);
  } else if (word == "elif" || word == "else") {
    flow_.alternative(begin, word == "else");
  } else if (word == "return" || word == "halt") {
    read_calls(end, std::min(text_.code().find('\n', end), text_.code().size()));
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

/// Those of an expression.
void UrScriptWay::read_calls(std::size_t begin, std::size_t end) {
  for (; begin < end; ++begin) {
    if (!text_.begins_word(begin)) continue;
    const std::size_t word_end = text_.word_end(begin);
    if (text_.next(word_end) == '(')
      flow_.call(begin, std::string(text_.code().substr(begin, word_end - begin)), false);
    begin = word_end - 1;
  }
}

/// NAME(...); where it is a statement, NAME may be a function that is not in the files.
void UrScriptWay::read_call(const std::string& word, std::size_t begin) {
  const std::string_view code = text_.code();
  const std::size_t last = begin == 0 ? std::string_view::npos : code.find_last_not_of(" \t\r", begin - 1);
  const bool statement =
      (last == std::string_view::npos || code[last] == '\n' || code[last] == ':') && !is_of_the_language(word);
  if (statement) calls_[begin] = word + "()";
  flow_.call(begin, word, statement);
}

StatedFrames UrScriptWay::held(std::size_t begin, bool by_pose) {
  const FrameFlow::Held found = flow_.at(begin);
  if (found.call && by_pose) believed_.insert(*found.call);
  return found.frames;
}

void UrScriptWay::note_routines(Program& program) const {
  flow_.end_at_routines(program);
  if (!believed_.empty())
    note_calls_elsewhere(text_, flow_.calls_elsewhere(), calls_, program, "put what they do into this file");
}

}  // namespace demecal::inline kuka_abb_ur
