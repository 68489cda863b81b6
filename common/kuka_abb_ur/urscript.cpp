// Universal Robots URScript: what movej, movel, movep, movec, servoj and servoc are sent to, as p[...] or [...], there
// or in the variable they name, inside get_inverse_kin() and in a feature, pose_trans(feature, p[...]).
#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cstddef>
#include <map>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "kinematics/chain.hpp"
#include "kuka_abb_ur/urscript_statements.hpp"
#include "kuka_abb_ur/urscript_way.hpp"
#include "parsed_programs/language.hpp"
#include "parsed_programs/orientation.hpp"
#include "parsed_programs/payload_values.hpp"
#include "parsed_programs/program.hpp"
#include "parsed_programs/program_text.hpp"

namespace demecal::inline kuka_abb_ur {
namespace {

class UrReader {
 public:
  explicit UrReader(const ReaderInput& input)
      : text_(input.source, {.comment = '#'}),
        code_(text_.code()),
        arm_(input.arm),
        controller_(input.controller),
        variables_(urscript_variables(text_)),
        way_(text_) {
    require_six_joints(input.arm, input.source.file(), "URScript");
  }

  Program read() {
    follow_tools();
    text_.for_each_word([&](std::size_t begin, std::size_t end) {
      const std::string_view word = code_.substr(begin, end - begin);
      const int targets = urscript_targets(word);
      if (targets == 0 || text_.next(end) != '(') return;
      use_ = {begin, word == "movej" || word == "servoj" || word == "optimovej" ? Motion::joints : Motion::line, {}};
      use_.frames = way_.held(end_of_call(end), is_to_pose(text_.skip_spaces(end) + 1));
      read_call(text_.skip_spaces(end), targets);
    });
    leave_targets_on_targets();
    mark_changed(text_, plain_, program_.targets);
    for (Target& target : program_.targets) take_uses(uses_at_.at(literal_of_.at(target.begin())), target);
    std::sort(program_.targets.begin(), program_.targets.end(),
              [](const Target& one, const Target& other) { return one.begin() < other.begin(); });
    way_.note_routines(program_);
    for (Target& target : program_.targets) {
      if (!way_.displaces().empty())
        target.not_sent_to =
            "the program displaces motions (" + way_.displaces() + "), and where it does is not followed";
    }
    return std::move(program_);
  }

 private:
  std::optional<std::size_t> literal_at(std::size_t offset) const { return urscript_literal(text_, offset); }

  void follow_tools() {
    text_.for_each_word([&](std::size_t begin, std::size_t end) {
      const bool sets_tool = code_.substr(begin, end - begin) == "set_tcp" && text_.next(end) == '(';
      way_.read_word(begin, end);
      if (sets_tool) way_.set_tool(end_of_call(end), tool_at(text_.skip_spaces(end) + 1));
    });
    way_.finish();
  }

  /// Where the call whose name ends at `end` is made: behind all that its arguments call.
  std::size_t end_of_call(std::size_t end) const {
    const std::size_t open = text_.skip_spaces(end);
    return urscript_close(text_, open).value_or(open);
  }

  /// Whether what a motion goes to is told by the tool: anything but joints.
  bool is_to_pose(std::size_t argument) const {
    std::size_t begin = text_.skip_spaces(argument);
    const auto variable = variables_.literals.find(word_from(argument));
    if (variable != variables_.literals.end()) begin = variable->second.front();
    return begin >= code_.size() || code_[begin] != '[';
  }

  /// Reads the first `targets` arguments of the call whose parenthesis opens at `open`.
  void read_call(std::size_t open, int targets) {
    std::size_t offset = open + 1;
    for (int i = 0; i < targets; ++i) {
      target_at(urscript_argument(text_, offset), {});
      offset = urscript_argument_end(text_, offset);
      if (offset >= code_.size() || code_[offset] != ',') return;
      ++offset;
    }
  }

  /// The target that an argument is: a literal, a variable that was given one, or a pose in get_inverse_kin().
  void target_at(std::size_t offset, const ArmHint& hint) {
    if (const auto literal = literal_at(offset)) return add(*literal, "", Numbers::or_expressions, hint);
    const std::size_t begin = text_.skip_spaces(offset), end = text_.word_end(begin);
    const std::string word(code_.substr(begin, end - begin));
    if (word == "get_inverse_kin" && text_.next(end) == '(') return inverse_kinematics(text_.skip_spaces(end));
    if (word == "pose_trans" && text_.next(end) == '(' && use_.frames.frame.empty())
      return in_feature(text_.skip_spaces(end), hint);
    const auto variable = variables_.literals.find(word);
    const char after = text_.next(end);
    if (variables_.parameters.contains(word) && (after == ',' || after == ')')) {
      elsewhere({.name = word, .place = text_.place(begin)}, word + " is handed to the function when the program runs");
    } else if (variable != variables_.literals.end() && (after == ',' || after == ')')) {
      plain_.insert(begin);
      const std::vector<std::size_t> literals = variables_.literals_at(word, use_.begin, way_.flow());
      if (literals.size() > 1) program_.joints_lost_at.push_back(use_.begin);  // to one of them
      for (const std::size_t literal : literals) add(literal, word, Numbers::or_expressions, hint);
    } else if (variables_.computed.contains(word) && (after == ',' || after == ')')) {
      elsewhere({.name = word, .place = text_.place(begin)}, word + " is computed when the program runs");
    } else {
      std::size_t first = begin;
      const std::string argument(text_.trimmed(first, urscript_argument_end(text_, begin)));
      elsewhere({.name = word, .place = text_.place(std::min(begin, code_.size()))},
                "'" + argument.substr(0, 40) + "' is not given as numbers in this file");
    }
  }

  /// Says why a motion goes to none of the targets.
  void elsewhere(const Target& target, const std::string& why) {
    note_unknown_motion(program_, use_.begin, target, why);
  }

  /// The word that begins at or after `offset`.
  std::string word_from(std::size_t offset) const {
    const std::size_t begin = text_.skip_spaces(offset);
    return std::string(code_.substr(begin, text_.word_end(begin) - begin));
  }

  /// The pose of a literal, or of a variable that is given one and no other.
  std::optional<Eigen::Isometry3d> pose_at(std::size_t offset) {
    std::optional<std::size_t> literal = literal_at(offset);
    plain_.insert(text_.skip_spaces(offset));
    if (!literal) literal = variables_.only_literal(word_from(offset));
    if (!literal || code_[*literal] != 'p') return std::nullopt;
    const auto values = list_numbers(text_, read_list(text_, text_.skip_spaces(*literal + 1), '['), 6);
    if (!values) return std::nullopt;
    Eigen::Isometry3d pose(rotation_from(OrientationForm::rotation_vector, {(*values)[3], (*values)[4], (*values)[5]}));
    pose.translation() = Eigen::Vector3d((*values)[0], (*values)[1], (*values)[2]);
    return pose;
  }

  /// What set_tcp() is given.
  KnownFrame tool_at(std::size_t argument) {
    const auto pose = pose_at(urscript_argument(text_, argument));
    return pose ? KnownFrame{"set_tcp", *pose, ""} : KnownFrame::computed("the tool of set_tcp");
  }

  /// pose_trans(feature, pose).
  void in_feature(std::size_t open, const ArmHint& hint) {
    const std::size_t second = urscript_argument_end(text_, open + 1);
    if (second >= code_.size() || code_[second] != ',') return;
    const StatedFrames outside = use_.frames;
    set_frame(use_.frames, feature(open + 1, second));
    target_at(second + 1, hint);
    use_.frames = outside;
  }

  /// The feature that stands at [begin, end).
  KnownFrame feature(std::size_t begin, std::size_t end) {
    const std::string argument(text_.trimmed(begin, end)), name = word_from(begin);
    const auto pose = pose_at(begin);
    const auto literal = literal_at(begin);
    if (literal && pose) {
      const BracketItem list = read_list(text_, text_.skip_spaces(*literal + 1), '[');
      if (text_.skip_spaces(list.begin + list.size) == text_.skip_spaces(end)) return {"pose_trans", *pose, ""};
    }
    if (argument.empty() || argument != name) return KnownFrame::computed("the feature of pose_trans");
    if (pose) return {name, *pose, ""};
    const bool set = variables_.literals.contains(name) || variables_.computed.contains(name);
    return set ? KnownFrame::computed("feature " + name) : controller_.frame(name, "feature " + name);
  }

  /// A feature that motions go to changes when it is corrected, and what hangs on it with it.
  void leave_targets_on_targets() {
    for (auto& [begin, uses] : uses_at_) {
      for (TargetUse& use : uses) {
        const auto variable = variables_.literals.find(use.frames.frame);
        if (variable == variables_.literals.end()) continue;
        const bool moved_to = std::any_of(variable->second.begin(), variable->second.end(),
                                          [&](std::size_t literal) { return seen_.contains(literal); });
        if (moved_to) use.frames.unknown_frame = "it hangs on " + use.frames.frame + ", which is itself moved to";
      }
    }
  }

  /// get_inverse_kin(x, qnear, ..., tcp): arguments by place or by name.
  void inverse_kinematics(std::size_t open) {
    constexpr std::array<std::string_view, 5> kArguments{"x", "qnear", "maxPositionError", "maxOrientationError",
                                                         "tcp"};
    std::map<std::string, std::size_t> given;
    std::size_t offset = open + 1;
    for (std::size_t i = 0; i < kArguments.size(); ++i) {
      const std::size_t value = urscript_argument(text_, offset);
      given.try_emplace(value == offset ? std::string(kArguments.at(i)) : word_from(offset), value);
      offset = urscript_argument_end(text_, offset);
      if (offset >= code_.size() || code_[offset] != ',') break;
      ++offset;
    }
    ArmHint hint;
    if (const auto near = given.find("qnear"); near != given.end()) hint.near = joints_at(near->second);
    const StatedFrames outside = use_.frames;
    if (const auto tool = given.find("tcp"); tool != given.end()) set_tool(use_.frames, tool_at(tool->second));
    if (const auto pose = given.find("x"); pose != given.end()) target_at(pose->second, hint);
    use_.frames = outside;
  }

  /// The joints that a literal or a variable gives; empty where it gives none.
  JointVector joints_at(std::size_t offset) {
    std::optional<std::size_t> literal = literal_at(offset);
    plain_.insert(text_.skip_spaces(offset));
    if (!literal) literal = variables_.only_literal(word_from(offset));
    if (!literal || code_[*literal] != '[') return {};
    const auto values = list_numbers(text_, read_list(text_, *literal, '['), arm_.joints.size());
    if (!values) return {};
    return Eigen::Map<const Eigen::VectorXd>(values->data(), arm_.size());
  }

  /// Makes a target of the literal at `begin`, unless it is one already.
  void add(std::size_t begin, const std::string& name, Numbers numbers, const ArmHint& hint) {
    uses_at_[begin].push_back(use_);
    if (!seen_.insert(begin).second) return;
    constexpr CellUnit kMetre{1.0, kDecimalsM}, kRadian{1.0, kDecimalsRad};
    constexpr std::array<CellUnit, 6> kPose{kMetre, kMetre, kMetre, kRadian, kRadian, kRadian};
    const bool pose = code_[begin] == 'p';
    const BracketItem list = read_list(text_, pose ? text_.skip_spaces(begin + 1) : begin, '[');
    Target target{.name = name, .place = text_.place(begin)};
    if (list.items.size() != kPose.size()) {
      text_.fail(begin, list.begin + list.size - begin,
                 pose ? "must have six numbers: x, y, z and a rotation vector" : "must have six joint angles");
    }
    std::vector<CellUnit> units(kPose.begin(), kPose.end());
    for (std::size_t i = 0; !pose && i < units.size(); ++i) {
      units[i] = is_revolute(arm_.joints[i]) ? kRadian : kMetre;
    }
    const auto cells = cells_of(text_, list.items, units, numbers, program_, target);
    if (!cells) return;
    if (pose) {
      target.position.assign(cells->begin(), cells->begin() + 3);
      target.orientation.assign(cells->begin() + 3, cells->end());
      target.form = OrientationForm::rotation_vector;
      target.hint = hint;
      if (const std::string why = longer_than_a_turn(target); !why.empty()) return skip_target(program_, target, why);
    } else {
      target.joints = *cells;
    }
    literal_of_[target.begin()] = begin;
    program_.targets.push_back(std::move(target));
  }

  ProgramText text_;
  std::string_view code_;
  const Chain& arm_;
  const ControllerData& controller_;
  Program program_;
  std::set<std::size_t> plain_;  ///< where variables stand for what they were given
  UrScriptVariables variables_;
  std::set<std::size_t> seen_;
  UrScriptWay way_;
  TargetUse use_;                                          ///< the motion that is being read
  std::map<std::size_t, std::vector<TargetUse>> uses_at_;  ///< of every literal
  std::map<std::size_t, std::size_t> literal_of_;          ///< the literal of a target, by its first number
};

std::string urscript_text(std::span<const ProgrammedStop> stops, const Chain& arm) {
  if (!has_six_revolute_joints(arm)) return {};
  std::string text = "def measure():\n";
  for (const ProgrammedStop& stop : stops) {
    text += "  movej([" + joints_text_si(stop.joints, ", ") + "], a=0.5, v=0.3)  # " + stop.name + '\n';
    if (stop.waits) text += "  popup(\"" + stop.name + "\", title=\"Measure\", blocking=True)\n";
  }
  return text + "end\n";
}

}  // namespace

Language urscript_language() {
  return {.name = "urscript",
          .title = "URScript",
          .file_endings = {"script", "urscript"},
          .signs = {"movej", "movel(", "movep("},
          .comment = "#",
          .openings = {"def ", "sec ", "thread ", "set_", "global "},
          .payload_statements = {{"set_payload(", number_argument},
                                 {"set_payload_mass(", number_argument},
                                 {"set_target_payload(", number_argument}},
          .read = [](const ReaderInput& input) { return UrReader(input).read(); },
          .write = urscript_text};
}

}  // namespace demecal::inline kuka_abb_ur
