#include "kuka_abb_ur/rapid_frames.hpp"

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <optional>
#include <string_view>
#include <utility>

#include "data/text.hpp"
#include "kuka_abb_ur/rapid_statements.hpp"
#include "parsed_programs/orientation.hpp"
#include "parsed_programs/program_text.hpp"

namespace demecal::inline kuka_abb_ur {
namespace {

/// [[x, y, z], [q1, q2, q3, q4]].
std::optional<Eigen::Isometry3d> rapid_frame(const ProgramText& text, const BracketItem& list) {
  if (!list.is_list || list.items.size() != 2) return std::nullopt;
  const auto position = list_numbers(text, list.items[0], 3), turn = list_numbers(text, list.items[1], 4);
  if (!position || !turn) return std::nullopt;
  double square = 0.0;
  for (const double part : *turn) square += part * part;
  if (std::abs(square - 1.0) > 0.02) return std::nullopt;
  Eigen::Isometry3d frame(rotation_from(OrientationForm::quaternion, *turn));
  frame.translation() = 1e-3 * Eigen::Vector3d((*position)[0], (*position)[1], (*position)[2]);
  return frame;
}

bool is_word(const ProgramText& text, const BracketItem& item, std::string_view word) {
  return lower_case(text.code().substr(item.begin, item.size)) == word;
}

KnownFrame declared_tool(const ProgramText& text, const BracketItem& list, const std::string& name) {
  if (list.items.size() != 3) return KnownFrame::computed("tool " + name);
  if (!is_word(text, list.items[0], "true")) {
    return {name, Eigen::Isometry3d::Identity(), "tool " + name + " stands beside the robot"};
  }
  const auto frame = rapid_frame(text, list.items[1]);
  return frame ? KnownFrame{name, *frame, ""} : KnownFrame::computed("tool " + name);
}

KnownFrame object_of(const ProgramText& text, const BracketItem& list, const std::string& name) {
  if (list.items.size() != 5) return KnownFrame::computed("work object " + name);
  const bool still = is_word(text, list.items[0], "false") && is_word(text, list.items[1], "true");
  if (!still) return {name, Eigen::Isometry3d::Identity(), "work object " + name + " is moved by a robot or a unit"};
  const auto user = rapid_frame(text, list.items[3]), object = rapid_frame(text, list.items[4]);
  return user && object ? KnownFrame{name, *user * *object, ""} : KnownFrame::computed("work object " + name);
}

KnownFrame hidden(const std::string& what) {
  return {what, Eigen::Isometry3d::Identity(), what + " is LOCAL to another file of the program"};
}

}  // namespace

RapidFrames::RapidFrames(const ProgramText& text, const ControllerData& controller)
    : text_(text), controller_(controller), displaced_(displaced_by_pdisp(text)) {
  const std::string_view code = text.code();
  tools_["tool0"] = {"tool0", Eigen::Isometry3d::Identity(), ""};
  frames_["wobj0"] = {"wobj0", Eigen::Isometry3d::Identity(), ""};
  const auto for_each_word = [&](const auto& visit) {
    text.for_each_word(
        [&](std::size_t begin, std::size_t end) { visit(begin, end, lower_case(code.substr(begin, end - begin))); });
  };
  for_each_word([&](std::size_t, std::size_t end, const std::string& word) {
    if (word == "tooldata" || word == "wobjdata") read_declaration(word, end);
    if (word == "proc" || word == "func") read_header(word == "proc" ? end : text.word_end(text.skip_spaces(end)));
  });
  for_each_word(
      [&](std::size_t begin, std::size_t end, const std::string& word) { forget_assigned(word, begin, end); });
  for_each_word([&](std::size_t begin, std::size_t end, const std::string& word) {
    if (targets_of_rapid_motion(word) > 0) read_move(begin, word, end);
  });
}

void RapidFrames::read_declaration(const std::string& type, std::size_t at) {
  const std::string_view code = text_.code();
  const std::size_t begin = text_.skip_spaces(at), end = text_.word_end(begin);
  if (end == begin) return;
  const std::string name(code.substr(begin, end - begin)), key = lower_case(name);
  const bool tool = type == "tooldata";
  auto& data = tool ? tools_ : frames_;
  declared_.insert(begin);
  const std::size_t statement = code.find_last_of(";\n", at) + 1;  // npos + 1: the text's begin
  const std::string_view before = code.substr(statement, at - statement);
  if (lower_case(before.substr(std::min(before.find_first_not_of(" \t"), before.size()))).starts_with("local"))
    local_to_[key] = text_.source().file_at(begin);
  const std::size_t sign = text_.skip_spaces(end);
  const std::size_t value = code.substr(sign).starts_with(":=") ? text_.skip_spaces(sign + 2) : code.size();
  if (value >= code.size() || code[value] != '[')
    return declare(data, key, KnownFrame::computed((tool ? "tool " : "work object ") + name));
  const BracketItem list = read_list(text_, value, '[');
  declare(data, key, tool ? declared_tool(text_, list, name) : object_of(text_, list, name));
}

/// Data that statements change are computed, and so are those that are handed to a procedure that may change them.
void RapidFrames::forget_assigned(const std::string& word, std::size_t begin, std::size_t end) {
  if (declared_.contains(begin)) return;
  const std::string_view code = text_.code();
  const std::string_view rest = code.substr(text_.skip_spaces(end));
  const bool argument_name = text_.option_sign(begin) != std::string_view::npos;  // such as \WObj:=
  if (!argument_name && (rest.starts_with(":=") || rest.starts_with('.'))) changed_.insert(word);
  if (word == "setdataval") {  // by names that may be computed
    for (const auto* data : {&tools_, &frames_}) {
      for (const auto& [name, frame] : *data) changed_.insert(name);
    }
  }
  if (!changers_.contains(word)) return;
  const std::size_t stop = std::min(code.find(';', end), code.size());
  for (std::size_t at = end; at < stop; ++at) {
    if (!text_.begins_word(at)) continue;
    if (const std::string name = text_.word_at(at); name != "tool0" && name != "wobj0") changed_.insert(name);
    at = text_.word_end(at) - 1;
  }
}

/// PROC NAME(... PERS tooldata ...): it may change what it is handed.
void RapidFrames::read_header(std::size_t end) {
  const std::size_t name = text_.skip_spaces(end), open = text_.skip_spaces(text_.word_end(name));
  if (open >= text_.code().size() || text_.code()[open] != '(') return;
  const std::size_t close = std::min(text_.code().find(')', open), text_.code().size());
  std::string before;
  for (std::size_t at = open; at < close; ++at) {
    if (!text_.begins_word(at)) continue;
    const std::string word = text_.word_at(at);
    const bool data = word == "tooldata" || word == "wobjdata";
    if (data && (before == "pers" || before == "inout" || before == "var")) changers_.insert(text_.word_at(name));
    before = word;
    at = text_.word_end(at) - 1;
  }
}

/// Whether the name is LOCAL to another file than that of the motion.
bool RapidFrames::is_hidden(const std::string& name, std::size_t begin) const {
  const auto local = local_to_.find(name);
  return local != local_to_.end() && local->second != text_.source().file_at(begin);
}

KnownFrame RapidFrames::known_tool(const std::string& written, std::size_t begin) const {
  const std::string name = lower_case(written);
  if (is_hidden(name, begin)) return hidden("tool " + written);
  if (changed_.contains(name)) return KnownFrame::computed("tool " + written);
  const auto found = tools_.find(name);
  return found != tools_.end() ? found->second : controller_.tool(name, "tool " + written);
}

KnownFrame RapidFrames::known_object(const std::string& written, std::size_t begin) const {
  const std::string name = lower_case(written);
  if (is_hidden(name, begin)) return hidden("work object " + written);
  if (changed_.contains(name)) return KnownFrame::computed("work object " + written);
  const auto found = frames_.find(name);
  return found != frames_.end() ? found->second : controller_.frame(name, "work object " + written);
}

void RapidFrames::read_move(std::size_t begin, const std::string& word, std::size_t end) {
  const std::string_view code = text_.code();
  std::vector<std::size_t> ends = argument_ends(code, end);
  if (text_.next(end) == '\\') {  // \Conc, before the first target
    end = std::min(ends.front() + 1, code.size());
    ends.erase(ends.begin());
  }
  if (ends.size() < 3) return;
  TargetUse use{begin, Motion::joints, {}};
  const bool line = word.starts_with("movel") || word.starts_with("movec") || word.starts_with("triggl");
  if (line || word == "triggc") use.motion = Motion::line;
  const auto is_tool = [&](const std::string& name) {
    return tools_.contains(name) || controller_.tools.contains(name);
  };
  // The tool: the last argument that is a tool of the program or, where none is, the last.
  std::string tool;
  for (std::size_t i = 1; i < ends.size(); ++i) {
    const std::size_t first = text_.skip_spaces(ends[i - 1] + 1);
    if (first >= ends[i]) continue;
    const std::string name(code.substr(first, std::min(text_.word_end(first), ends[i]) - first));
    if (is_tool(lower_case(name)) || (i + 1 == ends.size() && !is_tool(lower_case(tool)))) tool = name;
  }
  set_tool(use.frames, known_tool(tool, begin));
  const std::string all = lower_case(code.substr(end, ends.back() - end));
  std::size_t option = all.find("wobj");
  while (option != std::string::npos && text_.option_sign(end + option) == std::string_view::npos)
    option = all.find("wobj", option + 1);
  if (option != std::string::npos) {
    const std::size_t sign = all.find(":=", option);
    const std::size_t name = sign == std::string::npos ? ends.back() : text_.skip_spaces(end + sign + 2);
    set_frame(use.frames, known_object(std::string(code.substr(name, text_.word_end(name) - name)), begin));
  }
  for (const TextRange& range : displaced_) {
    if (begin >= range.begin && begin < range.end)
      use.frames.unknown_frame = "points are displaced by PDispSet or PDispOn";
  }
  const std::size_t targets = targets_of_rapid_motion(word);
  held_.push_back({end, ends[targets - 1], use});
  for (std::size_t at = end; at < ends[targets - 1]; ++at) {
    if (!text_.begins_word(at)) continue;
    std::size_t stop = text_.word_end(at);
    if (stop < code.size() && code[stop] == '{') stop = std::min(code.find('}', stop), code.size() - 1) + 1;
    std::string name = lower_case(code.substr(at, stop - at));
    std::erase(name, ' ');
    const std::size_t brace = name.find('{');
    const bool computed =
        brace != std::string::npos && name.find_first_not_of("0123456789,{}", brace) != std::string::npos;
    use.near = near_place(at, stop);
    uses_[computed ? name.substr(0, brace) : name].push_back(use);
    at = stop - 1;
  }
}

/// Of the name in Offs(NAME, x, y, z) or RelTool(NAME, x, y, z).
std::optional<NearPlace> RapidFrames::near_place(std::size_t name, std::size_t name_end) const {
  const std::string_view code = text_.code();
  const std::size_t open = code.find_last_not_of(" \t\r\n", name - 1);
  if (open == std::string_view::npos || open == 0 || code[open] != '(') return std::nullopt;
  const std::size_t last = code.find_last_not_of(" \t\r\n", open - 1);
  if (last == std::string_view::npos) return std::nullopt;
  std::size_t begin = last + 1;
  while (begin > 0 && is_word_letter(code[begin - 1])) --begin;
  const std::string function = lower_case(code.substr(begin, last + 1 - begin));
  if (function != "offs" && function != "reltool") return std::nullopt;
  NearPlace place{.along_tool = function == "reltool"};
  const std::size_t comma = text_.skip_spaces(name_end), close = code.find(')', name_end);
  const std::size_t before = begin == 0 ? std::string_view::npos : code.find_last_not_of(" \t\r\n", begin - 1);
  const bool inside_another = before != std::string_view::npos && code[before] == '(';
  if (comma < code.size() && code[comma] == ',' && close != std::string_view::npos && !inside_another)
    place.shift_m = rapid_shift_m(text_, comma + 1, close);
  return place;
}

/// The motions to the target, or to an element of its array that is not told.
std::vector<TargetUse> RapidFrames::uses_of(const std::string& name) const {
  std::vector<TargetUse> found;
  for (const std::string& key : std::set<std::string>{name, name.substr(0, name.find('{'))}) {
    const auto uses = uses_.find(key);
    if (uses != uses_.end()) found.insert(found.end(), uses->second.begin(), uses->second.end());
  }
  return found;
}

void RapidFrames::complete(Target& target) const {
  const std::size_t begin = target.begin();
  target.order = begin;
  if (const auto uses = uses_of(lower_case(target.name)); !target.name.empty() && !uses.empty())
    return take_uses(uses, target);
  for (const Held& held : held_) {
    if (begin >= held.begin && begin < held.end) return take_uses({held.use}, target);
  }
  if (held_.empty()) return;
  // Its tool and its work object are those of the motion that somewhere goes to it.
  target.frames.unknown_tool = target.frames.unknown_frame = "no motion names it";
}

}  // namespace demecal::inline kuka_abb_ur
