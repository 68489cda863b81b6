#include "languages/fanuc_ls_motions.hpp"

#include <algorithm>
#include <array>
#include <optional>
#include <string_view>
#include <utility>

#include "data/text.hpp"
#include "languages/fanuc_ls_instructions.hpp"

namespace demecal::inline languages {
namespace {

const std::string kIncrement = "a motion goes by it and not to it (INC)";
const std::string kOffset =
    "a motion to it also names a register or an offset, which is computed when the program runs";
const std::string kOtherGroup =
    "a motion to it goes with what another group of motion moves (COORD), whose frame is not followed";
const std::string kFixedTool = "a motion to it is told by a tool that stands beside the robot (RTCP)";

/// Where "GP2:" begins, of the instructions that Independent GP and Simultaneous GP move each group by; `end` where
/// none does.
std::size_t next_group(const ProgramText& text, std::size_t begin, std::size_t end) {
  for (std::size_t at = begin; at < end; ++at) {
    if (!text.begins_word(at)) continue;
    const std::string word = text.word_at(at);
    const std::size_t word_end = std::min(text.word_end(at), end);
    if (word.size() == 3 && word.starts_with("gp") && is_digit(word[2]) && text.next(word_end) == ':') return at;
    at = word_end - 1;
  }
  return end;
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
    constexpr std::array<std::string_view, 6> kWords{"settrig",  "accutrig", "linecount",
                                                     "selbound", "lnsch",    "stop_tracking"};
    const bool tracking = std::find(kWords.begin(), kWords.end(), word) != kWords.end();
    if (tracking || (word == "line" && text.next(end) == '[')) tracks = true;
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

void FanucMotions::read(const ProgramText& text, std::size_t begin, std::size_t end, ChangedNames& changes) {
  while (begin < end) {
    const std::size_t stop = std::min(text.code().find(';', begin), end);
    const std::size_t first = std::min(after_line_number(text.code().substr(0, stop), begin), stop);
    const bool remark = text.code().substr(first, stop - first).starts_with('!');
    std::size_t group = remark ? stop : next_group(text, first, stop);
    read_instruction(text, begin, group, changes);
    while (group < stop) {
      const bool of_arm = text.word_at(group) == "gp1";
      const std::size_t inside = text.word_end(group), next = next_group(text, inside, stop);
      if (of_arm) read_instruction(text, inside, next, changes);
      group = next;
    }
    begin = stop + 1;
  }
  way_.flow().finish();
}

void FanucMotions::read_instruction(const ProgramText& text, std::size_t begin, std::size_t end,
                                    ChangedNames& changes) {
  shifts_.read(text, begin, end);
  read_motion(text, begin, end);
  find_fanuc_changes(text, begin, end, changes);
  read_way(text, begin, end);
}

/// "  12:L P[3] 100mm/sec FINE INC", its line number and line breaks included.
void FanucMotions::read_motion(const ProgramText& text, std::size_t begin, std::size_t end) {
  const std::string_view code = text.code().substr(0, end);
  begin = after_line_number(code, begin);
  if (!is_fanuc_motion(code, begin)) return;
  const bool line = code[begin] != 'j' && code[begin] != 'J';
  std::vector<int> numbers;
  std::string why = shifts_.why();
  bool of_register = false, wrist_by_joints = false;
  for (std::size_t at = begin + 1; at < end; ++at) {
    if (!text.begins_word(at)) continue;
    const std::size_t word_end = std::min(text.word_end(at), end);
    const std::string word = lower_case(code.substr(at, word_end - at));
    const bool indexed = text.next(word_end) == '[' && text.skip_spaces(word_end) < end;
    if (word == "p" && indexed) numbers.push_back(position_number(text, text.skip_spaces(word_end)));
    if (word == "inc") why = kIncrement;
    if (why.empty() && (word == "coord" || word == "rtcp")) why = word == "coord" ? kOtherGroup : kFixedTool;
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

std::string FanucMotions::not_sent_to(int number) const {
  const auto found = not_sent_to_.find(number);
  if (found != not_sent_to_.end()) return found->second;
  const bool moved_to = uses_.contains(number);
  return computed_numbers_.empty() && moved_to ? shifts_.anywhere() : computed_numbers_;
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
