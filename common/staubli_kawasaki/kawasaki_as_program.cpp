#include "staubli_kawasaki/kawasaki_as_program.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <string_view>
#include <utility>

#include "data/text.hpp"
#include "staubli_kawasaki/location_names.hpp"

namespace demecal::inline staubli_kawasaki {
namespace {

constexpr std::array<std::string_view, 6> kConfigurations{"lefty", "righty", "above", "below", "uwrist", "dwrist"};

const std::string kSystemTool = "of .SYSDATA";  ///< no location's name, for it has a blank
const std::string kBlockTool = "block:";  ///< and the step's word for its tool; no location's name, for it has a colon

/// Motions to a location; those whose names begin with J and HMOVE move joint by joint.
bool is_motion(const std::string& word) {
  constexpr std::array<std::string_view, 9> kMotions{"jmove",  "lmove",  "hmove",  "xmove", "c1move",
                                                     "c2move", "jappro", "lappro", "smove"};
  return std::find(kMotions.begin(), kMotions.end(), word) != kMotions.end();
}

/// Whether + or - stand outside of parentheses.
bool is_sum(std::string_view argument) {
  int depth = 0;
  for (const char letter : argument) {
    if (depth == 0 && (letter == '+' || letter == '-')) return true;
    depth += letter == '(' || letter == '[' ? 1 : letter == ')' || letter == ']' ? -1 : 0;
  }
  return false;
}

/// Where the joints of a block step begin, "JOINT SPEED9 ACCU1 .. TOOL1 .. #[10,20,..]"; `end` where none stands there.
std::size_t find_block_step(const ProgramText& text, std::size_t begin, std::size_t end) {
  for (std::size_t at = begin; at < end && text.code()[at] != '"'; ++at) {
    if (text.code()[at] != '#') continue;
    const std::size_t open = text.skip_spaces(at + 1);
    if (open < end && text.code()[open] == '[') return at;
  }
  return end;
}

}  // namespace

/// A step that was taught by the pendant: it has its own joints and selects one of the controller's tools.
void AsStatements::read_block_step(const ProgramText& text, std::size_t begin, std::size_t joints, std::size_t end) {
  std::size_t first = joints;
  departures_.end();
  block_steps_.emplace_back(begin, std::string(text.trimmed(first, end)));
  std::string tool = kBlockTool;
  for (std::size_t at = begin; at < joints; ++at) {
    if (!text.begins_word(at)) continue;
    const std::string word = text.word_at(at);
    if (word.starts_with("tool")) tool = kBlockTool + word;
    at = text.word_end(at) - 1;
  }
  tools_.insert(tool);
  way_.tool(begin, tool);
}

void AsStatements::read_line(const ProgramText& text, std::size_t begin, std::size_t end) {
  way_.read_line(text, begin, end);
  begin = text.skip_spaces(begin);
  while (begin < end && is_digit(text.code()[begin])) ++begin;  // a label
  begin = text.skip_spaces(begin);
  if (begin >= end || !text.begins_word(begin)) return;
  const std::string word = text.word_at(begin);
  const std::size_t argument = text.skip_spaces(std::min(text.word_end(begin), end));
  if (std::find(kConfigurations.begin(), kConfigurations.end(), word) != kConfigurations.end())
    sets_configuration_ = word;
  if (const std::size_t joints = find_block_step(text, begin, end); joints < end)
    return read_block_step(text, begin, joints, end);
  if (is_motion(word)) return read_motion(text, word, begin, end);
  if (departures_.read(text, begin, argument, end)) return;
  if (moves_or_tells_anew(word)) departures_.end();
  if (word == "point" && argument < end) return read_point(text, argument, end);
  if (word == "call") return use_all(text, std::min(text.code().find('(', argument), end), end);
  if (word == "alter") displaces_ = true;
  const std::string name = location_name(text, begin, end);
  const bool assigns = text.next(begin + name.size()) == '=';
  if (assigns) changes_.changed(name, begin);
  if (word == "here" && argument < end) {
    not_sent_to_[location_key(location_name(text, argument, end))] = "it is taught anew when the program runs (HERE)";
    return;
  }
  if (word == "tool" || word == "base") {
    std::size_t first = std::min(argument, end);
    const std::string written = location_key(text.trimmed(first, end)), named = written.empty() ? "null" : written;
    (word == "tool" ? tools_ : bases_).insert(named);
    return word == "tool" ? way_.tool(begin, named) : way_.base(begin, named);
  }
  if (word == "decompose") return;  // only reads
  use_all(text, std::min(assigns ? begin + name.size() : text.word_end(begin), end), end);
  if (!assigns) add_unknown_statement(text, begin, std::min(argument, end), end, unknown_);
}

void AsStatements::read_system_line(const ProgramText& text, std::size_t begin, std::size_t end) {
  const std::string word = text.word_at(begin);
  if (word != "base" && word != "tool") return;
  bool moved = false;
  std::size_t at = text.word_end(text.skip_spaces(begin));
  while ((at = text.skip_spaces(at)) < end) {
    const std::size_t stop = std::min(text.code().find_first_of(" \t\r,", at), end);
    const auto cell = cell_at(text.text(), at, stop - at, {});
    moved = moved || !cell || cell->value != 0.0;
    at = std::max(stop, at + 1);
  }
  if (word == "base") system_base_ = system_base_ || moved;
  if (word == "tool" && moved) tools_.insert(kSystemTool);
}

void AsStatements::read_motion(const ProgramText& text, const std::string& word, std::size_t begin, std::size_t end) {
  const std::string_view code = text.code();
  const TargetUse use{begin, word.starts_with('j') || word == "hmove" ? Motion::joints : Motion::line, {}};
  const std::size_t first = text.skip_spaces(text.word_end(begin)), till = find_word(text, first, end, "till");
  const std::size_t last = std::min(end_of_argument(code, first, end), till);
  if (till < end) stopped_.push_back(till);
  departures_.end();
  if (first >= last) return;
  std::size_t trimmed = first;
  const std::string_view argument = text.trimmed(trimmed, last);
  if (auto literal = literal_at(text, first, last)) {
    literal->use = use;
    literals_.push_back(*literal);
    return;
  }
  const std::string name = location_name(text, first, last);
  if (name.size() == argument.size()) {
    TargetUse& own = uses_[location_key(name)].emplace_back(use);
    if (!word.ends_with("appro")) {
      if (till == end) departures_.arrive(begin, location_key(name), name);
      return;
    }
    std::size_t distance = std::min(last + 1, end);
    const std::string_view number = text.trimmed(distance, end_of_argument(code, distance, end));
    const auto cell = cell_at(code, distance, number.size(), {});
    approaches_.push_back({begin, name, cell ? std::optional(cell->value) : std::nullopt});
    own.near = place_before(approaches_.back().distance_mm);
    return;
  }
  computed_.emplace_back(first, std::string(argument));
  // SHIFT(p BY ...) and the like stay near p; a sum of transformations takes p as a frame or as a part of one.
  for (std::size_t at = first; at < last && is_sum(argument); ++at) {
    const std::string part = location_name(text, at, last);
    if (part.empty()) continue;
    not_sent_to_[location_key(part)] = "it is part of a sum of transformations";
    at += part.size() - 1;
  }
}

void AsStatements::use_all(const ProgramText& text, std::size_t begin, std::size_t end) {
  for (const std::string& name : location_names(text, begin, end)) changes_.used(name, begin);
}

void AsStatements::note_approaches(const ProgramText& text, Program& program) const {
  for (const Approach& approach : approaches_)
    note_offset(program, text.place(approach.begin), approach.name, approach.distance_mm);
}

/// "p = TRANS(...)", or anything else that p is given; "/Z p = 200" gives it a part.
void AsStatements::read_point(const ProgramText& text, std::size_t begin, std::size_t end) {
  const bool part = text.code()[begin] == '/';
  if (part) begin = std::min(text.skip_spaces(std::min(text.code().find_first_of(" \t", begin), end)), end);
  const std::string name = location_name(text, begin, end);
  const std::size_t sign = std::min(text.code().find('=', begin), end);
  if (name.empty() || sign >= end) return;
  if (auto literal = literal_at(text, text.skip_spaces(sign + 1), end); literal && !part) {
    literal->name = name;
    literals_.push_back(*literal);
    return;
  }
  not_sent_to_[location_key(name)] = "it is computed when the program runs (POINT)";
  std::size_t first = sign + 1;
  const std::string_view value = text.trimmed(first, end);
  const bool copied = location_name(text, first, end).size() == value.size();
  if (!copied && (text.word_at(first) != "shift" || is_sum(value))) use_all(text, first, end);
}

/// TRANS(...) or #PPOINT(...) that is all of [begin, end).
std::optional<LocationLiteral> AsStatements::literal_at(const ProgramText& text, std::size_t begin,
                                                        std::size_t end) const {
  const std::string_view code = text.code();
  const bool of_joints = begin < end && code[begin] == '#';
  const std::size_t word = begin + (of_joints ? 1 : 0);
  if (word >= end || !text.begins_word(word) || text.word_at(word) != (of_joints ? "ppoint" : "trans"))
    return std::nullopt;
  const std::size_t open = text.skip_spaces(text.word_end(word)), close = code.find(')', open);
  if (open >= end || code[open] != '(' || close >= end || text.skip_spaces(close + 1) < end) return std::nullopt;
  LocationLiteral literal{"", {open, close + 1 - open, true, {}}, begin, of_joints, std::nullopt};
  for (std::size_t at = open + 1; at <= close;) {
    const std::size_t stop = std::min(code.find(',', at), close);
    std::size_t first = at;
    const std::string_view item = text.trimmed(first, stop);
    literal.list.items.push_back({first, item.size(), false, {}});
    at = stop + 1;
  }
  return literal;
}

KnownFrame AsStatements::tool_of(const std::string& word, const Lookup& lookup) const {
  if (word == "null") return {"flange", Eigen::Isometry3d::Identity(), ""};
  if (word.starts_with(kBlockTool))
    return {"TOOL", Eigen::Isometry3d::Identity(), "a block step selects one of the controller's tools"};
  const auto pose = word == kSystemTool ? std::nullopt : lookup.tool(word);
  return pose ? KnownFrame{word, *pose, ""} : KnownFrame::computed("TOOL");
}

KnownFrame AsStatements::base_of(const std::string& word, const Lookup& lookup) const {
  if (word == "null") return {"base", Eigen::Isometry3d::Identity(), ""};
  const auto pose = lookup.base(word);
  if (pose) return {word, *pose, ""};
  return {word, Eigen::Isometry3d::Identity(),
          "the base is moved by BASE, and --frames gives no frame '" + word + "' that says where to"};
}

bool AsStatements::sets_tool() const {
  return tools_.size() > 1 || (tools_.size() == 1 && !tools_.begin()->starts_with(kBlockTool));
}

StatedFrames AsStatements::frames(const Lookup& lookup) const {
  StatedFrames frames;
  if (tools_.size() == 1 && sets_tool()) set_tool(frames, tool_of(*tools_.begin(), lookup));
  if (tools_.size() > 1) set_tool(frames, {"TOOL", Eigen::Isometry3d::Identity(), "several tools are set by TOOL"});
  std::set<std::string> bases = bases_;
  if (system_base_ || (bases.empty() && lookup.base("base"))) bases.insert("base");
  if (bases.size() == 1) set_frame(frames, base_of(*bases.begin(), lookup));
  if (bases.size() > 1) set_frame(frames, {"BASE", Eigen::Isometry3d::Identity(), "several bases are set by BASE"});
  return frames;
}

StatedFrames AsStatements::frames_at(std::size_t motion, bool of_pose, const Lookup& lookup) {
  StatedFrames held = frames(lookup);
  const LocationFrames::Words words = way_.at(motion, of_pose);
  const auto unset = [](const std::string& what) {
    return KnownFrame{what, Eigen::Isometry3d::Identity(), what + " is set only after a motion to it"};
  };
  if (!sets_tool()) {
    // The controller's one tool is that of the model, as where nothing sets a tool.
  } else if (!words.tool.unknown.empty()) {
    set_tool(held, {"TOOL", Eigen::Isometry3d::Identity(), words.tool.unknown});
  } else if (!words.tool.word.empty()) {
    set_tool(held, tool_of(words.tool.word, lookup));
  } else if (!tools_.empty()) {
    set_tool(held, tools_.contains(kSystemTool) ? tool_of(kSystemTool, lookup) : unset("TOOL"));
  }
  if (!words.base.unknown.empty()) {
    set_frame(held, {"BASE", Eigen::Isometry3d::Identity(), words.base.unknown});
  } else if (!words.base.word.empty()) {
    set_frame(held, base_of(words.base.word, lookup));
  } else if (!bases_.empty()) {
    set_frame(held, system_base_ || lookup.base("base") ? base_of("base", lookup) : unset("BASE"));
  }
  return held;
}

std::string AsStatements::not_sent_to(const std::string& name) const {
  const auto found = not_sent_to_.find(name);
  return found == not_sent_to_.end() ? changes_.why(name) : found->second;
}

std::vector<TargetUse> AsStatements::uses(const std::string& name) const {
  const auto found = uses_.find(name);
  return found == uses_.end() ? std::vector<TargetUse>{} : found->second;
}

}  // namespace demecal::inline staubli_kawasaki
