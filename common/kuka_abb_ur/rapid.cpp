// ABB RAPID: robtarget and jointtarget, declared (arrays too) or in motion commands. The first of their external axes
// are the rails that carry the arm, as many as it has.
#include <algorithm>
#include <array>
#include <cstddef>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "data/text.hpp"
#include "kinematics/chain.hpp"
#include "kuka_abb_ur/rapid_frames.hpp"
#include "kuka_abb_ur/rapid_statements.hpp"
#include "kuka_abb_ur/rapid_way.hpp"
#include "parsed_programs/language.hpp"
#include "parsed_programs/orientation.hpp"
#include "parsed_programs/payload_values.hpp"
#include "parsed_programs/program.hpp"
#include "parsed_programs/program_text.hpp"

namespace demecal::inline kuka_abb_ur {
namespace {

constexpr std::array<std::size_t, 4> kRobtarget{3, 4, 4, 6};
constexpr std::array<std::size_t, 2> kJointtarget{6, 6};
constexpr double kNoAxis = 9e9;

std::string axis_named(std::size_t axis) {
  return std::string("eax_") + static_cast<char>('a' + axis);
}

/// Whether the item is a list of lists of these sizes, of nothing deeper.
bool has_shape(const BracketItem& item, std::span<const std::size_t> sizes) {
  if (!item.is_list || item.items.size() != sizes.size()) return false;
  for (std::size_t i = 0; i < sizes.size(); ++i) {
    const BracketItem& part = item.items[i];
    if (!part.is_list || part.items.size() != sizes[i]) return false;
    for (const BracketItem& number : part.items) {
      if (number.is_list) return false;
    }
  }
  return true;
}

/// Whether the program computes the list, or one of those in it: names stand where its lists are to be.
bool is_computed(const ProgramText& text, const BracketItem& item) {
  const auto is_name = [&](const BracketItem& part) {
    return !part.is_list && is_expression(text.code().substr(part.begin, part.size));
  };
  return item.is_list ? std::ranges::any_of(item.items, is_name) : is_name(item);
}

class RapidReader {
 public:
  explicit RapidReader(const ReaderInput& input)
      : text_(input.source, {.comment = '!'}),
        arm_(input.arm),
        controller_(input.controller),
        rails_(static_cast<std::size_t>(rails_of(input.arm, input.source.file(), "RAPID"))) {
    text_.for_each_word([&](std::size_t begin, std::size_t /*end*/) {
      const std::string word = text_.word_at(begin);
      offsets_axes_ = offsets_axes_ || word == "eoffson" || word == "eoffsset";
    });
  }

  Program read() {
    const std::string_view code = text_.code();
    for (std::size_t at = 0; at < code.size();) {
      if (text_.begins_word(at)) {
        const std::size_t end = text_.word_end(at);
        const std::string word = lower_case(code.substr(at, end - at));
        at = word == "robtarget" || word == "jointtarget" ? declaration(word, end) : end;
      } else if (code[at] == '[') {
        const BracketItem list = read_list(text_, at, '[');
        find_targets(list, "");
        at += list.size;
      } else {
        ++at;
      }
    }
    const RapidFrames frames(text_, controller_);
    for (Target& target : program_.targets) complete(frames, target);
    const RapidStatements statements(text_, program_);
    end_at_rapid_routines(text_, program_);
    forget_stated_configurations(text_, program_);
    if (!frames.has_motions() && std::any_of(program_.targets.begin(), program_.targets.end(),
                                             [](const Target& target) { return target.is_pose(); }))
      program_.remarks.push_back({kWholeProgram, "",
                                  "no motion is in the files given: poses are taken to be of the model's tool in the "
                                  "base frame; --with FILE takes in the module that moves to them"});
    return std::move(program_);
  }

 private:
  /// A motion's frames, unless what carries the arm is elsewhere.
  void complete(const RapidFrames& frames, Target& target) const {
    const std::string carried = std::exchange(target.frames.unknown_frame, "");
    frames.complete(target);
    if (!carried.empty()) target.frames.unknown_frame = carried;
  }

  /// Reads `NAME{n} := [...]` after the type's word; returns where to go on.
  std::size_t declaration(const std::string& type, std::size_t at) {
    const std::string_view code = text_.code();
    const std::size_t begin = text_.skip_spaces(at), end = text_.word_end(begin);
    std::size_t next = text_.skip_spaces(end);
    int dimensions = 0;
    if (next < code.size() && code[next] == '{') {
      const BracketItem list = read_list(text_, next, '{');
      dimensions = static_cast<int>(list.items.size());
      next = text_.skip_spaces(next + list.size);
    }
    if (!code.substr(next).starts_with(":=")) return end;
    next = text_.skip_spaces(next + 2);
    if (next >= code.size() || code[next] != '[') return next;
    const BracketItem list = read_list(text_, next, '[');
    declared(list, dimensions, type == "robtarget", std::string(code.substr(begin, end - begin)));
    return next + list.size;
  }

  void declared(const BracketItem& item, int dimensions, bool is_robtarget, const std::string& name) {
    if (dimensions > 0 && item.is_list) {
      int index = 0;
      for (const BracketItem& inner : item.items) {
        declared(inner, dimensions - 1, is_robtarget, name + '{' + std::to_string(++index) + '}');
      }
    } else if (is_computed(text_, item)) {
      skip_target(program_, {.name = name, .place = text_.place(item.begin)},
                  "'" + std::string(text_.code().substr(item.begin, item.size)) + "' has names in place of numbers");
    } else if (is_robtarget) {
      if (!has_shape(item, kRobtarget)) {
        text_.fail(item.begin, item.size,
                   "must be a robtarget: [[x, y, z], [q1, q2, q3, q4], [cf1, cf4, cf6, cfx], [six external axes]]");
      }
      robtarget(item, name, Numbers::or_expressions);
    } else {
      if (!has_shape(item, kJointtarget)) {
        text_.fail(item.begin, item.size, "must be a jointtarget: [[six joints], [six external axes]]");
      }
      jointtarget(item, name, Numbers::or_expressions);
    }
  }

  /// Targets of either shape, wherever they stand.
  void find_targets(const BracketItem& item, const std::string& name) {
    if (has_shape(item, kRobtarget)) {
      robtarget(item, name, Numbers::or_expressions);
    } else if (has_shape(item, kJointtarget)) {
      jointtarget(item, name, Numbers::or_expressions);
    } else {
      for (const BracketItem& inner : item.items) find_targets(inner, name);
    }
  }

  void robtarget(const BracketItem& item, const std::string& name, Numbers numbers) {
    constexpr std::array<CellUnit, 3> kPosition{kMillimetres, kMillimetres, kMillimetres};
    constexpr CellUnit kPart{1.0, kDecimalsQuaternion};
    constexpr std::array<CellUnit, 4> kQuaternion{kPart, kPart, kPart, kPart};
    constexpr std::array<CellUnit, 4> kConfiguration{};
    Target target{.name = name, .place = text_.place(item.begin)};
    if (!take_rails(target, item.items[3], numbers)) return;
    const auto position = cells_of(text_, item.items[0].items, kPosition, numbers, program_, target);
    if (!position) return;
    const auto orientation = cells_of(text_, item.items[1].items, kQuaternion, numbers, program_, target);
    if (!orientation) return;
    const auto configuration = cells_of(text_, item.items[2].items, kConfiguration, numbers, program_, target);
    if (!configuration) return;
    require_quaternion(text_, *orientation);
    target.position = *position;
    target.orientation = *orientation;
    target.form = OrientationForm::quaternion;
    target.hint = quadrants(*configuration);
    target.frames.unknown_frame = carried_by(item.items[3]);
    program_.targets.push_back(std::move(target));
  }

  /// cf1, cf4 and cf6 are the quadrants of joints 1, 4 and 6; what cfx means differs between arms.
  ArmHint quadrants(const std::vector<Cell>& configuration) const {
    ArmHint hint;
    hint.quadrants.resize(arm_.joints.size());
    const std::array<std::size_t, 3> joints{rails_, rails_ + 3, rails_ + 5};
    for (std::size_t i = 0; i < joints.size(); ++i) {
      const double quadrant = configuration[i].value;
      if (!is_revolute(arm_.joints[joints[i]]) || !(quadrant >= -100.0 && quadrant <= 100.0)) continue;
      hint.quadrants[joints[i]] = static_cast<int>(quadrant);
    }
    return hint;
  }

  /// Where the rails stand; false, and a remark, where that is not told.
  bool take_rails(Target& target, const BracketItem& axes, Numbers numbers) {
    const std::vector<CellUnit> units = joint_units(arm_);
    for (std::size_t rail = 0; rail < rails_; ++rail) {
      const auto cells = cells_of(text_, {&axes.items[rail], 1}, {&units[rail], 1}, numbers, program_, target);
      if (!cells) return false;
      const std::string where = ", where the rail that carries the arm is to stand";
      if (offsets_axes_ || cells->front().value == kNoAxis) {
        skip_target(program_, target,
                    offsets_axes_ ? "EOffsOn or EOffsSet moves " + axis_named(rail) + where
                                  : "its " + axis_named(rail) + where + ", is 9E9, which tells none");
        return false;
      }
      target.carried.push_back(cells->front());
    }
    return true;
  }

  /// What external axes behind the rails say of where the arm stands; empty where there are none (9E9), or none has
  /// moved.
  std::string carried_by(const BracketItem& axes) const {
    for (std::size_t i = rails_; i < axes.items.size(); ++i) {
      const auto cell = cell_at(text_.text(), axes.items[i].begin, axes.items[i].size, {});
      if (cell && (cell->value == kNoAxis || (cell->value == 0.0 && !offsets_axes_))) continue;
      return "an external axis, " + axis_named(i) + ", may carry the arm" +
             (cell && cell->value == 0.0 ? " (EOffsOn or EOffsSet moves it)" : "");
    }
    return "";
  }

  void jointtarget(const BracketItem& item, const std::string& name, Numbers numbers) {
    Target target{.name = name, .place = text_.place(item.begin)};
    if (!take_rails(target, item.items[1], numbers)) return;
    const auto joints =
        cells_of(text_, item.items[0].items, joint_units(arm_, static_cast<int>(rails_)), numbers, program_, target);
    if (!joints) return;
    target.joints = *joints;
    program_.targets.push_back(std::move(target));
  }

  ProgramText text_;
  const Chain& arm_;
  const ControllerData& controller_;
  std::size_t rails_;
  Program program_;
  bool offsets_axes_ = false;  ///< by EOffsOn or EOffsSet
};

/// Of the loaddata that GripLoad names: load0, which every controller has, or one that the program declares.
std::optional<double> grip_load_kg(std::string_view code, std::size_t at) {
  const std::string_view name = load_name(code, at);
  return name == "load0" ? std::optional(0.0) : declared_load_kg(code, name, ":=", "[");
}

std::string rapid_text(std::span<const ProgrammedStop> stops, const Chain& arm) {
  constexpr std::size_t kExternalAxes = 6;
  std::string targets, moves;
  for (const ProgrammedStop& stop : stops) {
    const auto carried = carried_stop(arm, stop.joints);
    if (!carried) return {};
    std::vector<std::string> external = rail_texts(*carried);
    external.resize(std::max(external.size(), kExternalAxes), "9E+09");
    targets += "  CONST jointtarget " + stop.name + ":=[[" + joints_text(carried->arm, carried->joints, ",") + "],[" +
               joined_words(external, ",") + "]];\n";
    moves += "    MoveAbsJ " + stop.name + ",v100,fine,tool0;\n";
    if (stop.waits) moves += "    Stop;\n";
  }
  return "MODULE measure\n" + targets + "  PROC main()\n" + moves + "  ENDPROC\nENDMODULE\n";
}

}  // namespace

Language rapid_language() {
  return {.name = "rapid",
          .title = "ABB RAPID",
          .file_endings = {"mod", "modx", "sys", "sysx", "rapid"},
          .signs = {"robtarget", "jointtarget", "endmodule"},
          .comment = "!",
          .headers = {"module"},
          .openings = {"proc ", "%%%"},
          .payload_statements = {{"gripload ", grip_load_kg}},
          .of_several_files = true,
          .read = [](const ReaderInput& input) { return RapidReader(input).read(); },
          .write = rapid_text};
}

}  // namespace demecal::inline kuka_abb_ur
