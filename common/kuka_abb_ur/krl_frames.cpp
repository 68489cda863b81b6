#include "kuka_abb_ur/krl_frames.hpp"

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <numbers>
#include <optional>
#include <set>
#include <string_view>
#include <utility>
#include <vector>

#include "data/text.hpp"
#include "kuka_abb_ur/krl_statements.hpp"
#include "parsed_programs/orientation.hpp"
#include "parsed_programs/program_text.hpp"

namespace demecal::inline kuka_abb_ur {
namespace {

constexpr int kAnyNumber = -2;  // where it is computed which one is changed
constexpr std::array<std::string_view, 6> kFrameParts{"x", "y", "z", "a", "b", "c"};

/// The values of an aggregate's components by name, in small letters.
std::map<std::string, std::string> parts_of(const ProgramText& text, const BracketItem& list) {
  std::map<std::string, std::string> parts;
  for (const BracketItem& item : list.items) {
    if (item.is_list) continue;
    const std::size_t end = item.begin + item.size;
    std::size_t begin = item.begin;
    const std::size_t colon = text.code().substr(0, end).find(':', begin);
    if (colon != std::string_view::npos) begin = std::min(text.skip_spaces(colon + 1), end);
    std::size_t value = std::min(text.word_end(begin), end);
    const std::string name = lower_case(text.code().substr(begin, value - begin));
    parts[name] = lower_case(text.trimmed(value, end));
  }
  return parts;
}

std::optional<double> component_number(const std::map<std::string, std::string>& parts, std::string_view name) {
  const auto part = parts.find(std::string(name));
  if (part == parts.end()) return std::nullopt;
  const auto cell = cell_at(part->second, 0, part->second.size(), {});
  return cell ? std::optional(cell->value) : std::nullopt;
}

/// The frame that {X .., Y .., Z .., A .., B .., C ..} writes; nothing where it is not all numbers.
std::optional<Eigen::Isometry3d> frame_of(const ProgramText& text, const BracketItem& list) {
  const std::map<std::string, std::string> parts = parts_of(text, list);
  std::array<double, 6> values{};
  for (std::size_t i = 0; i < values.size(); ++i) {
    const auto value = component_number(parts, kFrameParts[i]);
    if (!value) return std::nullopt;
    values[i] = *value;
  }
  constexpr double kDegree = std::numbers::pi / 180.0;
  Eigen::Isometry3d frame(
      rotation_from(OrientationForm::zyx_angles, {values[3] * kDegree, values[4] * kDegree, values[5] * kDegree}));
  frame.translation() = 1e-3 * Eigen::Vector3d(values[0], values[1], values[2]);
  return frame;
}

/// $NULLFRAME, where no sum begins with it.
bool is_null_frame(const ProgramText& text, std::size_t begin) {
  return text.word_at(begin) == "$nullframe" && text.next(text.word_end(text.skip_spaces(begin))) != ':';
}

/// A frame's number; one that no controller has where the value is no such number.
int frame_number(double value) {
  constexpr double kMost = 1e6;
  return value >= 0.0 && value <= kMost && value == std::floor(value) ? static_cast<int>(value) : -1;
}

std::string numbered_name(bool of_tool, int number) {
  return (of_tool ? "TOOL_DATA[" : "BASE_DATA[") + std::to_string(number) + ']';
}

bool is_line(const std::string& word) {
  return points_of_krl_motion(word) > 0 && word != "ptp" && word != "sptp";
}

/// Of bases, which count in the world, where a statement sets where the robot stands there.
KnownFrame world_is_unknown() {
  return KnownFrame::computed("$ROBROOT, which places the robot in the world,");
}

}  // namespace

KrlFrames::KrlFrames(const ProgramText& text, const ControllerData& controller) : text_(text), controller_(controller) {
  text.for_each_word([&](std::size_t begin, std::size_t end) { read_data(begin, end); });
  text.for_each_word([&](std::size_t begin, std::size_t end) {
    const auto data = data_of_.find(text.word_at(begin));
    if (data == data_of_.end() || text.next(end) != '.') return;
    const std::size_t sign = text.skip_spaces(text.word_end(text.skip_spaces(text.skip_spaces(end) + 1)));
    if (text.next(sign) == '=' && text.next(sign + 1) != '=')
      data->second.unknown = data->first + " is changed when the program runs";
  });
  const std::string_view code = text.code();
  std::size_t file = text.source().files().size();
  for (std::size_t begin = 0; begin < code.size();) {
    const std::size_t end = std::min(code.find('\n', begin), code.size());
    if (text.source().file_at(begin) != file) {
      file = text.source().file_at(begin);
      flow_.begin_routine(begin, "", file);
    }
    read_line(begin, end);
    begin = end + 1;
  }
  flow_.finish();
}

/// TOOL_DATA[n]={...}, BASE_DATA[n]={...} and FDAT NAME={...}.
void KrlFrames::read_data(std::size_t begin, std::size_t end) {
  const std::string_view code = text_.code();
  const std::string word = lower_case(code.substr(begin, end - begin));
  std::size_t next = text_.skip_spaces(end);
  if ((word == "tool_data" || word == "base_data") && text_.next(next) == '[') {
    const std::size_t close = std::min(code.find(']', next), code.size());
    const auto number = cell_at(code, next + 1, close - std::min(close, next + 1), {});
    std::size_t sign = text_.skip_spaces(std::min(close + 1, code.size()));
    const char before = begin == 0 ? ' ' : code[std::min(code.find_last_not_of(" \t", begin - 1), begin - 1)];
    const bool handed_on = (before == '(' || before == ',') && (text_.next(sign) == ')' || text_.next(sign) == ',');
    if (handed_on) changed_.insert({word == "tool_data", number ? frame_number(number->value) : kAnyNumber});
    const bool part = text_.next(sign) == '.';
    if (part) sign = text_.skip_spaces(text_.word_end(text_.skip_spaces(sign + 1)));
    if (text_.next(sign) != '=' || text_.next(text_.skip_spaces(sign) + 1) == '=') return;
    const bool null = is_null_frame(text_, std::min(sign + 1, code.size()));
    if (part || !number || (text_.next(sign + 1) != '{' && !null)) {
      changed_.insert({word == "tool_data", number ? frame_number(number->value) : kAnyNumber});
      return;
    }
    const auto frame = null ? std::optional(Eigen::Isometry3d::Identity())
                            : frame_of(text_, read_list(text_, text_.skip_spaces(sign + 1), '{'));
    const std::string name = numbered_name(word == "tool_data", frame_number(number->value));
    auto& data = word == "tool_data" ? tool_data_ : base_data_;
    declare(data, frame_number(number->value), frame ? KnownFrame{name, *frame, ""} : KnownFrame::computed(name));
  } else if (word == "fdat") {
    const std::string name = text_.word_at(next);
    const std::size_t sign = text_.skip_spaces(next + name.size());
    if (name.empty() || text_.next(sign) != '=' || text_.next(sign + 1) != '{') return;
    const auto parts = parts_of(text_, read_list(text_, text_.skip_spaces(sign + 1), '{'));
    const auto held = parts.find("ipo_frame");
    const FrameNumbers numbers{frame_number(component_number(parts, "tool_no").value_or(0.0)),
                               frame_number(component_number(parts, "base_no").value_or(0.0)),
                               held == parts.end() || held->second != "#tcp"};
    const auto [before, fresh] = data_of_.try_emplace(name, numbers);
    if (!fresh && !(before->second == numbers)) before->second.unknown = name + " is given more than once";
  }
}

KnownFrame KrlFrames::numbered(bool of_tool, int number) const {
  if (!of_tool && root_moved_) return world_is_unknown();
  const std::string name = numbered_name(of_tool, number);
  if (number == 0) return {of_tool ? "flange" : "base", Eigen::Isometry3d::Identity(), ""};
  if (changed_.contains({of_tool, number}) || changed_.contains({of_tool, kAnyNumber}))
    return KnownFrame::computed(name);
  const auto& data = of_tool ? tool_data_ : base_data_;
  const auto found = data.find(number);
  if (found != data.end()) return found->second;
  return of_tool ? controller_.tool(std::to_string(number), name) : controller_.frame(std::to_string(number), name);
}

KnownFrame KrlFrames::tool_of(const FrameNumbers& numbers) const {
  KnownFrame tool = numbered(true, numbers.tool);
  if (!numbers.tool_on_robot) tool.unknown = "the tool stands beside the robot";
  if (!numbers.unknown.empty()) tool.unknown = numbers.unknown;
  return tool;
}

KnownFrame KrlFrames::base_of(const FrameNumbers& numbers) const {
  KnownFrame base = numbered(false, numbers.base);
  if (!numbers.unknown.empty()) base.unknown = numbers.unknown;
  return base;
}

/// What stands behind "$TOOL =" or "$BASE =".
KnownFrame KrlFrames::assigned(std::size_t at_value, const std::string& what) const {
  const std::size_t begin = text_.skip_spaces(at_value);
  if (root_moved_ && what == "$BASE" && text_.word_at(begin) != "$robroot") return world_is_unknown();
  if (text_.next(begin) == '{') {
    const auto frame = frame_of(text_, read_list(text_, begin, '{'));
    return frame ? KnownFrame{what, *frame, ""} : KnownFrame::computed(what);
  }
  const std::string word = text_.word_at(begin);
  const std::size_t after = text_.skip_spaces(begin + word.size());
  // The robot stands there, wherever that is in the world.
  if (word == "$robroot" && what == "$BASE" && text_.next(after) != ':')
    return {kKrlRobotRoot, Eigen::Isometry3d::Identity(), ""};
  if (is_null_frame(text_, begin) || (word == "$world" && text_.next(after) != ':'))
    return {std::string(text_.code().substr(begin, word.size())), Eigen::Isometry3d::Identity(), ""};
  if ((word == "tool_data" || word == "base_data") && text_.next(after) == '[') {
    const std::size_t close = std::min(text_.code().find(']', after), text_.code().size());
    const auto number = cell_at(text_.code(), after + 1, close - std::min(close, after + 1), {});
    if (number && close < text_.code().size() && text_.next(close + 1) != ':') {
      return numbered(word == "tool_data", frame_number(number->value));
    }
  }
  return KnownFrame::computed(what);
}

void KrlFrames::read_assignment(bool of_tool, std::size_t begin, std::size_t next) {
  const std::string what = of_tool ? "$TOOL" : "$BASE";
  const bool part = text_.next(next) == '.';
  const bool whole = text_.next(next) == '=' && text_.next(text_.skip_spaces(next) + 1) != '=';
  if (!part && !whole) return;
  const KnownFrame frame = part ? KnownFrame::computed(what) : assigned(text_.skip_spaces(next) + 1, what);
  of_tool ? flow_.set_tool(begin, frame) : flow_.set_frame(begin, frame);
}

/// BAS(#TOOL, n) and BAS(#BASE, n).
void KrlFrames::read_bas(std::size_t begin, std::size_t open) {
  const std::string_view code = text_.code();
  if (text_.next(open) != '(') return;
  const std::size_t hash = text_.skip_spaces(text_.skip_spaces(open) + 1);
  if (text_.next(hash) != '#') return;
  const std::string word = text_.word_at(hash + 1);
  if (word == "ex_base") return flow_.set_frame(begin, KnownFrame::computed("the base of BAS"));
  if (word != "tool" && word != "base") return;
  const std::size_t comma = text_.skip_spaces(text_.word_end(text_.skip_spaces(hash + 1)));
  const std::size_t close = std::min(code.find(')', comma), code.size());
  std::size_t value = std::min(comma + 1, close);
  const std::string_view number_text = text_.trimmed(value, close);
  const auto number = cell_at(code, value, number_text.size(), {});
  const bool of_tool = word == "tool";
  const KnownFrame frame = number ? numbered(of_tool, frame_number(number->value))
                                  : KnownFrame::computed(of_tool ? "the tool of BAS" : "the base of BAS");
  of_tool ? flow_.set_tool(begin, frame) : flow_.set_frame(begin, frame);
}

void KrlFrames::apply_data(std::size_t begin, const FrameNumbers& numbers) {
  flow_.set_tool(begin, tool_of(numbers));
  flow_.set_frame(begin, base_of(numbers));
}

void KrlFrames::read_motion(const std::string& word, std::size_t begin, std::size_t next) {
  const Motion motion = is_line(word) ? Motion::line : Motion::joints;
  motions_[begin] = motion;
  const std::size_t line_end = std::min(text_.code().find('\n', begin), text_.code().size());
  for (std::size_t points = points_of_krl_motion(word); points > 0 && next < line_end; --points) {
    const std::size_t first = std::min(text_.skip_spaces(next), line_end);
    if (const std::size_t word_end = std::min(text_.word_end(first), line_end); word_end > first) {
      const std::size_t open = text_.skip_spaces(word_end);
      const bool element = open < line_end && text_.code()[open] == '[';
      const std::size_t end = element ? std::min(text_.code().find(']', open), line_end - 1) + 1 : word_end;
      const auto [stem, index] = krl_point_name(text_.code().substr(first, end - first));
      uses_[stem].push_back({index, {begin, motion, {}}});
    }
    next = next_krl_argument(text_.code(), next, line_end);
  }
}

void KrlFrames::read_statement(std::size_t begin, std::size_t end) {
  const std::string word = lower_case(text_.code().substr(begin, end - begin));
  if (word == "$tool" || word == "$base") return read_assignment(word == "$tool", begin, end);
  if (word == "bas") return read_bas(begin, end);
  if (word == "$ipo_mode" && text_.next(end) == '=')
    tool_beside_ = tool_beside_ ||
                   !lower_case(text_.code().substr(text_.skip_spaces(text_.skip_spaces(end) + 1))).starts_with("#base");
  const std::size_t before = begin == 0 ? text_.code().npos : text_.code().find_last_not_of(" \t", begin - 1);
  const bool is_read = before != text_.code().npos && text_.code()[before] == '=';
  const bool moves_root = word == "$robroot" && text_.next(end) != ',' && !is_read;
  if (moves_root) flow_.set_frame(begin, KnownFrame::computed("$ROBROOT"));
  root_moved_ = root_moved_ || moves_root;
  if (word == "fdat_act" && text_.next(end) == '.') {
    flow_.set_tool(begin, KnownFrame::computed("the tool of FDAT_ACT"));
    flow_.set_frame(begin, KnownFrame::computed("the base of FDAT_ACT"));
  }
  if (word == "fdat_act" && text_.next(end) == '=') {
    const std::string name = text_.word_at(text_.skip_spaces(end) + 1);
    const auto data = data_of_.find(name);
    if (data != data_of_.end()) return apply_data(begin, data->second);
    flow_.set_tool(begin, KnownFrame::computed("the tool of FDAT_ACT"));
    flow_.set_frame(begin, KnownFrame::computed("the base of FDAT_ACT"));
  }
  if (points_of_krl_motion(word) > 0) read_motion(word, begin, end);
}

/// What holds for a motion, of a pose or of joints.
StatedFrames KrlFrames::held(std::size_t begin, bool by_pose) {
  const FrameFlow::Held found = flow_.at(begin);
  if (found.call && by_pose) believed_.insert(*found.call);
  StatedFrames frames = found.frames;
  for (const With& with : with_) {
    if (begin < with.begin || begin >= with.end) continue;
    (with.of_tool ? frames.unknown_tool : frames.unknown_frame) =
        std::string(with.of_tool ? "$TOOL" : "$BASE") + " is set for this motion by WITH, which is not followed";
  }
  if (tool_beside_) frames.unknown_tool = "the tool may stand beside the robot ($IPO_MODE)";
  return frames;
}

}  // namespace demecal::inline kuka_abb_ur
