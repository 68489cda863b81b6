// FANUC TP programs as .LS listings: the positions of the section /POS, of joints (J1 to J6) or Cartesian (X, Y, Z and
// W, P, R: turns about x, y, z that stay), each with the numbers of its user frame (UF) and tool (UT). Groups of motion
// after the first are kept, and so are external axes (E1, ...), of which the first are the rails that carry the arm.
#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cstddef>
#include <map>
#include <numbers>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "data/text.hpp"
#include "kinematics/chain.hpp"
#include "languages/fanuc_ls_instructions.hpp"
#include "languages/fanuc_ls_motions.hpp"
#include "languages/fanuc_ls_positions.hpp"
#include "parsed_programs/changed_names.hpp"
#include "parsed_programs/language.hpp"
#include "parsed_programs/orientation.hpp"
#include "parsed_programs/program.hpp"
#include "parsed_programs/program_text.hpp"

namespace demecal::inline languages {
namespace {

constexpr std::array<std::string_view, 6> kJointNames{"j1", "j2", "j3", "j4", "j5", "j6"};
constexpr std::array<std::string_view, 6> kPoseNames{"x", "y", "z", "w", "p", "r"};
constexpr CellUnit kWprAngle{std::numbers::pi / 180.0, kDecimalsDeg};

class FanucReader {
 public:
  explicit FanucReader(const ReaderInput& input)
      : text_(input.source, {}),
        instructions_(input.source, {.strings = false}),
        code_(text_.code()),
        arm_(input.arm),
        controller_(input.controller),
        rails_(rails_of(input.arm, input.source.file(), "FANUC's TP")) {}

  Program read() {
    const std::size_t instructions = fanuc_section(text_, "/mn"), positions = fanuc_section(text_, "/pos");
    moves_arm_ = moves_first_group(text_, instructions);
    if (instructions < positions) motions_.read(instructions_, instructions, positions, changes_);
    for (const auto& [begin, goal] : motions_.to_others())
      skip_target(program_, {.name = "", .place = text_.place(begin)},
                  goal.empty() ? "the motion goes to a register, whose value is not in this file"
                               : "the motion goes to '" + goal + "', which is computed when the program runs");
    for (std::size_t at = positions; at < code_.size(); ++at) {
      if (!text_.begins_word(at) || text_.word_at(at) != "p" || text_.next(text_.word_end(at)) != '[') continue;
      at = read_position(at, text_.skip_spaces(text_.word_end(at)));
    }
    changes_.mark(program_.targets);
    note_other_zero();
    end_at_motions_elsewhere();
    motions_.note_way(instructions_, program_);
    for (Target& target : program_.targets)
      if (target.is_pose() && tracks_a_line(text_))
        target.frames.unknown_frame = "it may move with a line that is tracked";
    program_.joint_counting = fanuc_joint_counting(program_.targets, arm_);
    return std::move(program_);
  }

 private:
  /// Says that the controller's number 0 is not what --frames gives.
  void note_other_zero() {
    const auto other = [](const std::map<std::string, Eigen::Isometry3d>& given) {
      const auto zero = given.find("0");
      return zero != given.end() && !zero->second.isApprox(Eigen::Isometry3d::Identity(), 1e-9);
    };
    const auto note = [&](const std::string& what, const std::string& is) {
      program_.remarks.push_back({kWholeProgram, "",
                                  "--frames gives " + what + " 0 numbers that are not 0, but FANUC's is always " + is +
                                      ": they are not used; give them under the number that the positions name"});
    };
    const auto named = [&](const auto& name) { return std::ranges::any_of(program_.targets, name); };
    if (other(controller_.frames) &&
        named([](const Target& target) { return target.is_pose() && target.frames.frame == "UF 0"; }))
      note("frame", "the arm's base");
    if (other(controller_.tools) && named([](const Target& target) { return target.frames.tool_name == "UT 0"; }))
      note("tool", "the flange");
  }

  /// Where motions go to none of the targets; positions that are not in the file are said.
  void end_at_motions_elsewhere() {
    std::set<std::string> corrected;
    for (const Target& target : program_.targets) corrected.insert(target.name);
    for (const auto& [number, uses] : motions_.uses()) {
      const std::string name = "P[" + std::to_string(number) + ']';
      if (corrected.contains(name)) continue;
      for (const TargetUse& use : uses) {
        program_.joints_lost_at.push_back(use.begin);
        if (!given_.contains(number))
          skip_target(program_, {.name = name, .place = text_.place(use.begin)}, "it is not given in this file");
      }
    }
  }

  /// Reads P[n]{...}, whose bracket opens at `open`; returns the last byte that was read.
  std::size_t read_position(std::size_t begin, std::size_t open) {
    const std::size_t close = std::min(code_.find(']', open), code_.size());
    const std::size_t brace = close < code_.size() ? text_.skip_spaces(close + 1) : code_.size();
    if (brace >= code_.size() || code_[brace] != '{') return std::min(close, code_.size() - 1);
    const std::size_t end = code_.find('}', brace);
    if (end == std::string_view::npos) text_.fail(begin, 1, "opens a position that is never closed");
    const int number = position_number(text_, open);
    Target target{.name = "P[" + std::to_string(number) + ']', .place = text_.place(begin)};
    if (number < 0) text_.fail(open, close + 1 - open, "must be the number of a position");
    given_.insert(number);
    const auto parts = fanuc_position_parts(text_, brace + 1, end);
    parts ? make_target(number, *parts, std::move(target))
          : skip_target(program_, target, "it is of another group of motion than the first");
    return end;
  }

  void make_target(int number, const FanucParts& components, Target target) {
    const std::string why = motions_.not_sent_to(number);
    if (!why.empty()) return skip_target(program_, target, why);
    if (!moves_arm_)
      return skip_target(program_, target, "the program does not move the first group of motion (DEFAULT_GROUP)");
    set_frames(components, target);
    const auto joints = items(components, kJointNames), parts = items(components, kPoseNames);
    const bool of_joints = joints.size() == kJointNames.size() && parts.empty();
    if (!of_joints && parts.size() != kPoseNames.size()) {
      return skip_target(program_, target, "it names neither J1 to J6 nor X, Y, Z, W, P and R");
    }
    const std::vector<BracketItem>& used = of_joints ? joints : parts;
    if (std::any_of(used.begin(), used.end(), [&](const BracketItem& item) { return is_untaught(item); })) {
      return skip_target(program_, target, "it is not taught");
    }
    if (!has_units(components, of_joints)) {
      return skip_target(program_, target, "its numbers are not in mm and deg, in which the arm's are");
    }
    if (!take_rails(target, components)) return;
    of_joints ? joint_target(target, joints) : pose_target(target, parts, components);
    if (target.joints.empty() && target.position.empty()) return;
    motions_.complete(number, target);
    if (target.is_pose())
      target.not_sent_to = motions_.stopped_by(text_, number, word_of(components, "uf"), word_of(components, "ut"));
    program_.targets.push_back(std::move(target));
  }

  bool is_untaught(const BracketItem& item) const { return code_.substr(item.begin, item.size).starts_with("***"); }

  bool has_units(const FanucParts& components, bool of_joints) const {
    const auto has = [&](std::string_view name, std::string_view unit) {
      const auto found = components.find(std::string(name));
      return found != components.end() && found->second.unit == unit;
    };
    for (std::size_t i = 0; i < kJointNames.size(); ++i) {
      const bool angle = of_joints ? is_revolute(arm_, rails_ + static_cast<int>(i)) : i >= 3;
      if (!has(of_joints ? kJointNames[i] : kPoseNames[i], angle ? "deg" : "mm")) return false;
    }
    return true;
  }

  static std::vector<BracketItem> items(const FanucParts& components, std::span<const std::string_view> names) {
    std::vector<BracketItem> found;
    for (const std::string_view name : names) {
      if (const auto part = components.find(std::string(name)); part != components.end())
        found.push_back(part->second.value);
    }
    return found;
  }

  /// Where the rails stand; false, and a remark, where that is not told in mm.
  bool take_rails(Target& target, const FanucParts& components) {
    for (int rail = 0; rail < rails_; ++rail) {
      const std::string name = "e" + std::to_string(rail + 1);
      const auto part = components.find(name);
      if (part == components.end() || part->second.unit != "mm" || is_untaught(part->second.value)) {
        skip_target(program_, target,
                    "it does not state E" + std::to_string(rail + 1) +
                        " in mm, where the rail that carries the arm is to stand");
        return false;
      }
      const BracketItem& value = part->second.value;
      target.carried.push_back(text_.number(value.begin, value.size, kMillimetres));
    }
    return true;
  }

  void joint_target(Target& target, const std::vector<BracketItem>& joints) {
    if (const auto cells = cells_of(text_, joints, joint_units(arm_, rails_), Numbers::required, program_, target))
      target.joints = *cells;
  }

  void pose_target(Target& target, const std::vector<BracketItem>& parts, const FanucParts& components) {
    constexpr std::array<CellUnit, 6> kUnits{kMillimetres, kMillimetres, kMillimetres, kWprAngle, kWprAngle, kWprAngle};
    const auto cells = cells_of(text_, parts, kUnits, Numbers::required, program_, target);
    if (!cells) return;
    target.position.assign(cells->begin(), cells->begin() + 3);
    target.orientation.assign(cells->begin() + 3, cells->end());
    target.form = OrientationForm::fixed_xyz_angles;
    for (const char* name : {"config", "konfig"}) {
      const auto words = components.find(name);
      if (words == components.end()) continue;
      const BracketItem& value = words->second.value;
      target.hint.configuration = text_.text().substr(value.begin, value.size);
      std::erase_if(target.hint.configuration, [](char letter) { return letter == ' ' || letter == '\t'; });
      const auto rails = static_cast<std::size_t>(rails_);
      target.hint.counted_turns = {rails, rails + 3, rails + 5};
      target.hint.turns = fanuc_turns(target.hint.configuration);
      if (!target.hint.turns.empty()) target.hint.turns.insert(target.hint.turns.begin(), rails, std::nullopt);
    }
  }

  std::string word_of(const FanucParts& components, const std::string& name) const {
    const auto found = components.find(name);
    if (found == components.end()) return "";
    return std::string(code_.substr(found->second.value.begin, found->second.value.size));
  }

  /// UF 0 is the arm's base, UT 0 its flange; others are set in the controller.
  void set_frames(const FanucParts& components, Target& target) const {
    const std::string frame = word_of(components, "uf"), tool = word_of(components, "ut");
    const auto known = [&](const std::string& word, const std::string& number) {
      if (number == "0") return KnownFrame{word + " 0", Eigen::Isometry3d::Identity(), ""};
      if (lower_case(number) == "f") return KnownFrame::computed(word);
      const std::string name = word + ' ' + number;
      const std::string changed = changes_.why((word == "UF" ? "UFRAME[" : "UTOOL[") + number + ']');
      if (!changed.empty()) return KnownFrame{name, Eigen::Isometry3d::Identity(), name + " is not known: " + changed};
      return word == "UF" ? controller_.frame(number, name) : controller_.tool(number, name);
    };
    if (!frame.empty()) set_frame(target.frames, known("UF", frame));
    if (!tool.empty()) set_tool(target.frames, known("UT", tool));
    for (const auto& [name, component] : components) {
      const bool external = name.size() == 2 && name.front() == 'e' && is_digit(name.back());
      if (!external || component.unit != "mm" || (name.back() - '0' <= rails_ && name.back() != '0')) continue;
      const auto cell = cell_at(text_.text(), component.value.begin, component.value.size, {});
      if (cell && cell->value == 0.0) continue;
      target.frames.unknown_frame = "an external axis that slides, " + name + ", may carry the arm";
    }
  }

  ProgramText text_;
  /// The same for /MN, where remarks and the names of positions may have one quote, of inches.
  ProgramText instructions_;
  std::string_view code_;
  const Chain& arm_;
  const ControllerData& controller_;
  int rails_;
  Program program_;
  FanucMotions motions_;
  ChangedNames changes_{text_};
  bool moves_arm_ = true;
  std::set<int> given_;  ///< the numbers of all positions of the file
};

std::string fanuc_text(std::span<const ProgrammedStop> stops, const Chain& arm) {
  std::string motions, positions;
  int line = 0, number = 0;
  const auto instruction = [&](const std::string& words) {
    motions += "  " + std::to_string(++line) + ':' + words + " ;\n";
  };
  for (const ProgrammedStop& stop : stops) {
    const auto carried = carried_stop(arm, stop.joints);
    if (!carried) return {};
    const std::string at = std::to_string(++number);
    instruction("J P[" + at + "] 20% FINE");
    if (stop.waits) instruction("  PAUSE");
    positions += "P[" + at + ":\"" + stop.name + "\"]{\n   GP1:\n\tUF : 0, UT : 0,\n\t";
    const std::string joints = joints_text(carried->arm, carried->joints, ",");
    std::size_t begin = 0;
    for (int joint = 1; joint <= carried->arm.size(); ++joint) {
      const std::size_t end = std::min(joints.find(',', begin), joints.size());
      positions +=
          (joint > 1 ? ", J" : "J") + std::to_string(joint) + "= " + joints.substr(begin, end - begin) + " deg";
      begin = end + 1;
    }
    int rail = 0;
    for (const std::string& place : rail_texts(*carried))
      positions += ",\n\tE" + std::to_string(++rail) + "= " + place + "  mm";
    positions += "\n};\n";
  }
  return "/PROG  MEASURE\n/ATTR\nDEFAULT_GROUP\t= 1,*,*,*,*;\n/MN\n" + motions + "/POS\n" + positions + "/END\n";
}

}  // namespace

Language fanuc_ls_language() {
  return {.name = "fanuc_ls",
          .title = "FANUC LS",
          .file_endings = {"ls"},
          .signs = {"/prog "},
          .comment = "   :  !",
          .comment_end = " ;",
          .longest_comment = 31,  // a remark has 32 letters at most
          .headers = {"/mn"},
          .payload_statements = {{.begin = "payload["}},
          .read = [](const ReaderInput& input) { return FanucReader(input).read(); },
          .write = fanuc_text};
}

}  // namespace demecal::inline languages
