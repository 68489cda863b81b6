#include "staubli_kawasaki/val2_program.hpp"

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <numbers>
#include <optional>
#include <set>
#include <string_view>

#include "data/text.hpp"
#include "staubli_kawasaki/location_names.hpp"

namespace demecal::inline staubli_kawasaki {
namespace {

std::string lower_name(const Target& target) {
  return location_key(target.name);
}

std::size_t statement_of(const ProgramText& text, std::size_t begin, std::size_t end) {
  begin = text.skip_spaces(begin);
  while (begin < end && is_digit(text.code()[begin])) ++begin;  // a label
  return text.skip_spaces(begin);
}

/// BASE dx, dy, dz, turn: how the robot's base was moved in the world that points are in, mm and degrees about z; what
/// is left out is 0. The frame that points are in is the way back.
KnownFrame base_of(const std::string& argument) {
  std::array<double, 4> values{};
  std::size_t begin = 0;
  for (std::size_t i = 0; i < values.size() && begin <= argument.size(); ++i) {
    const std::size_t end = std::min(argument.find(',', begin), argument.size());
    if (end > begin) {
      const auto cell = cell_at(argument, begin, end - begin, {});
      if (!cell) return KnownFrame::computed("BASE");
      values[i] = cell->value;
    }
    begin = end + 1;
  }
  if (begin <= argument.size()) return KnownFrame::computed("BASE");
  Eigen::Isometry3d moved(
      Eigen::AngleAxisd(values[3] * std::numbers::pi / 180.0, Eigen::Vector3d::UnitZ()).toRotationMatrix());
  moved.translation() = 1e-3 * Eigen::Vector3d(values[0], values[1], values[2]);
  return {"BASE", moved.inverse(), ""};
}

KnownFrame tool_of(const std::string& argument, const Program& program, const ControllerData& controller) {
  if (argument.empty() || argument == "null" || argument == "nulltool") {
    return {"flange", Eigen::Isometry3d::Identity(), ""};
  }
  std::map<std::string, KnownFrame> found;
  for (const Target& target : program.targets) {
    if (target.is_pose() && lower_name(target) == argument)
      declare(found, argument, {target.name, stated_tool_pose(target), ""});
  }
  if (!found.empty()) return found.at(argument);
  return controller.tools.contains(argument) ? controller.tool(argument, argument) : KnownFrame::computed("TOOL");
}

/// The only one of the arguments; nothing where they differ.
std::optional<std::string> only(const std::vector<std::string>& arguments) {
  const std::set<std::string> different(arguments.begin(), arguments.end());
  return different.size() == 1 ? std::optional(*different.begin()) : std::nullopt;
}

bool is_motion_of_val2(const std::string& word) {
  constexpr std::array<std::string_view, 6> kMotions{"move", "moves", "movet", "movest", "appro", "appros"};
  return std::find(kMotions.begin(), kMotions.end(), word) != kMotions.end();
}

}  // namespace

void Val2Statements::read_line(std::size_t begin, std::size_t end) {
  const std::string_view code = text_.code();
  way_.read_line(text_, begin, end);
  begin = statement_of(text_, begin, end);
  if (begin >= end || !text_.begins_word(begin)) return;
  const std::size_t word_end = std::min(text_.word_end(begin), end);
  const std::string word = lower_case(code.substr(begin, word_end - begin));
  const std::size_t argument = std::min(text_.skip_spaces(word_end), end);
  if (is_motion_of_val2(word)) return read_motion(word, begin, argument, end);
  if (departures_.read(text_, begin, argument, end)) return;
  if (moves_or_tells_anew(word)) departures_.end();
  if (word == "set") return read_set(argument, end);
  constexpr std::array<std::string_view, 6> kConfigurations{"lefty", "righty", "above", "below", "flip", "noflip"};
  if (std::find(kConfigurations.begin(), kConfigurations.end(), word) != kConfigurations.end())
    sets_configuration_ = word;
  if (word == "here") return changes_.recorded(location_name(text_, argument, end), begin);
  if (word == "alter") displaces_ = true;
  if (word == "decompose") return;  // only reads
  if (word != "tool" && word != "base") return read_other(begin, word_end, end);
  std::string named = lower_case(code.substr(word_end, end - word_end));
  std::erase_if(named, [](char letter) { return letter == ' ' || letter == '\t' || letter == '\r'; });
  if (named.empty()) named = word == "tool" ? "null" : "0";
  (word == "tool" ? tools_ : bases_).push_back(named);
  word == "tool" ? way_.tool(begin, named) : way_.base(begin, named);
}

void Val2Statements::read_motion(const std::string& word, std::size_t statement, std::size_t begin, std::size_t end) {
  const std::size_t last = end_of_argument(text_.code(), begin, end);
  std::size_t first = begin;
  std::string argument(text_.trimmed(first, last));
  if (argument.ends_with('!')) argument.pop_back();  // the motion is being recorded
  const std::string name = location_name(text_, first, first + argument.size());
  departures_.end();
  if (name.empty() || name.size() != argument.size()) {
    computed_.emplace_back(statement, argument);
    if (argument.find(':') == std::string::npos) return;
    for (const std::string& part : location_names(text_, first, last)) changes_.used(part, statement);
    return;
  }
  const bool line = word == "moves" || word == "movest" || word == "appros";
  TargetUse& own =
      uses_[location_key(name)].emplace_back(TargetUse{statement, line ? Motion::line : Motion::joints, {}});
  if (!word.starts_with("appro")) return departures_.arrive(statement, location_key(name), name);
  std::size_t distance = std::min(last + 1, end);
  const std::string_view number = text_.trimmed(distance, end);
  const auto cell = cell_at(text_.code(), distance, number.size(), {});
  approaches_.push_back({statement, name, cell ? std::optional(cell->value) : std::nullopt});
  own.near = place_before(approaches_.back().distance_mm);
}

/// What is none of the statements known, such as WINDOW, and what computes: y = DX(a), IF DISTANCE(a, b) < 5 THEN.
void Val2Statements::read_other(std::size_t statement, std::size_t word_end, std::size_t end) {
  for (const std::string& name : location_names(text_, word_end, end)) changes_.used(name, statement);
  add_unknown_statement(text_, statement, word_end, end, unknown_);
}

/// "SET a = b": only copies and SHIFT leave the locations on the right what they are.
void Val2Statements::read_set(std::size_t begin, std::size_t end) {
  const std::string name = location_name(text_, begin, end);
  const std::size_t sign = std::min(text_.code().find('=', begin), end);
  if (name.empty() || sign >= end) return;
  changes_.changed(name, begin);
  std::size_t first = sign + 1;
  const std::string_view value = text_.trimmed(first, end);
  const bool whole = location_name(text_, first, end).size() == value.size();
  if (whole || (text_.word_at(first) == "shift" && value.find(':') == std::string_view::npos)) return;
  for (const std::string& part : location_names(text_, first, end)) changes_.used(part, begin);
}

KnownFrame Val2Statements::tool(const std::string& word, const Program& program, const ControllerData& controller) {
  const auto [found, fresh] = known_tools_.try_emplace(word);
  if (fresh)
    found->second = changes_.why(word).empty() ? tool_of(word, program, controller) : KnownFrame::computed("TOOL");
  return found->second;
}

KnownFrame Val2Statements::base(const std::string& word, const ControllerData& controller) {
  const KnownFrame base = base_of(word);
  if (base.unknown.empty()) return base;
  if (controller.frames.contains("base")) return controller.frame("base", "BASE");
  return {"BASE", Eigen::Isometry3d::Identity(), base.unknown + ", and --frames gives no frame 'base'"};
}

/// Of a location that no motion names: those that serve all of them.
StatedFrames Val2Statements::frames(const Program& program, const ControllerData& controller) {
  StatedFrames frames;
  if (!tools_.empty()) {
    const auto argument = only(tools_);
    set_tool(frames, argument ? tool(*argument, program, controller)
                              : KnownFrame{"TOOL", Eigen::Isometry3d::Identity(), "several tools are set by TOOL"});
  }
  if (!bases_.empty()) {
    const auto argument = only(bases_);
    set_frame(frames, argument ? base(*argument, controller)
                               : KnownFrame{"BASE", Eigen::Isometry3d::Identity(), "several bases are set by BASE"});
  } else if (controller.frames.contains("base")) {
    set_frame(frames, controller.frame("base", "BASE"));
  }
  return frames;
}

StatedFrames Val2Statements::frames_at(std::size_t motion, bool of_pose, StatedFrames held, const Program& program,
                                       const ControllerData& controller) {
  const LocationFrames::Words words = way_.at(motion, of_pose);
  const auto unset = [](const std::string& what) { return what + " is set only after a motion to it"; };
  const auto why = [&](const LocationFrames::Word& one, const std::string& what) {
    return KnownFrame{what, Eigen::Isometry3d::Identity(), one.unknown.empty() ? unset(what) : one.unknown};
  };
  if (!tools_.empty())
    set_tool(held, words.tool.word.empty() ? why(words.tool, "TOOL") : tool(words.tool.word, program, controller));
  if (bases_.empty()) return held;
  if (!words.base.word.empty()) {
    set_frame(held, base(words.base.word, controller));
  } else if (words.base.unknown.empty() && controller.frames.contains("base")) {
    set_frame(held, controller.frame("base", "BASE"));
  } else {
    set_frame(held, why(words.base, "BASE"));
  }
  return held;
}

void Val2Statements::complete(Program& program, const ControllerData& controller) {
  way_.finish();
  departures_.take(text_, way_.flow(), uses_, program);
  const Program read = program;
  const StatedFrames stated = frames(program, controller);
  note_untold_locations(
      text_, uses_, [&](const std::string& name) { return changes_.why(name); }, program);
  std::erase_if(program.targets, [&](const Target& target) {
    if (std::find(tools_.begin(), tools_.end(), lower_name(target)) == tools_.end()) return false;
    const auto motions = uses_.find(lower_name(target));
    if (motions != uses_.end()) leave_frame(target, motions->second, program);
    return true;
  });
  for (Target& target : program.targets) {
    target.frames = stated;
    target.order = target.begin();
    const auto found = uses_.find(lower_name(target));
    if (found == uses_.end()) continue;
    std::vector<TargetUse> uses = found->second;
    for (TargetUse& use : uses) use.frames = frames_at(use.begin, target.is_pose(), stated, read, controller);
    take_uses(uses, target);
  }
  changes_.mark(program.targets);
  end_at_unknown_statements(unknown_, program);
  for (Target& target : program.targets) {
    if (displaces_ && target.not_sent_to.empty()) target.not_sent_to = kAltered;
    if (sets_configuration_.empty() || !target.is_pose() || !target.not_sent_to.empty()) continue;
    target.not_sent_to =
        "the program sets the arm's configuration (" + sets_configuration_ + "), and where it holds is not followed";
  }
  for (const Approach& approach : approaches_)
    note_offset(program, text_.place(approach.begin), approach.name, approach.distance_mm);
  for (const auto& [begin, what] : computed_) {
    note_unknown_motion(program, begin, {.name = "", .place = text_.place(begin)},
                        '\'' + what + "' is computed when the program runs");
  }
  way_.note_routines(text_, program);
}

}  // namespace demecal::inline staubli_kawasaki
