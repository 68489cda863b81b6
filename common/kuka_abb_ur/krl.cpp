// KUKA KRL: AXIS, E6AXIS, POS and E6POS, declared or in motion commands; neither frames nor relative motions. E1 and
// those behind it are the rails that carry the arm, as many as it has.
#include <algorithm>
#include <array>
#include <cstddef>
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
#include "kuka_abb_ur/krl_frames.hpp"
#include "kuka_abb_ur/krl_loads.hpp"
#include "kuka_abb_ur/krl_statements.hpp"
#include "parsed_programs/language.hpp"
#include "parsed_programs/orientation.hpp"
#include "parsed_programs/program.hpp"
#include "parsed_programs/program_text.hpp"

namespace demecal::inline kuka_abb_ur {
namespace {

constexpr int kDeepestAggregate = 20;
constexpr std::array<std::string_view, 6> kPoseParts{"x", "y", "z", "a", "b", "c"};
constexpr std::array<std::string_view, 6> kAxisComponents{"a1", "a2", "a3", "a4", "a5", "a6"};

/// What the words before an aggregate, or its own type, say of it.
struct Context {
  bool pose = false;      ///< POS or E6POS
  bool axis = false;      ///< AXIS or E6AXIS
  bool motion = false;    ///< a command that moves to it, or its name is declared as a pose's
  bool relative = false;  ///< a motion by it rather than to it
  bool frame = false;     ///< a frame, a base or a tool
  bool declared() const { return pose || axis; }
};

void take_word(const std::string& word, Context& context) {
  constexpr std::array<std::string_view, 9> kMotions{"ptp",   "lin", "circ",    "sptp", "slin",
                                                     "scirc", "spl", "ptp_lin", "async"};
  context.pose = context.pose || word == "pos" || word == "e6pos";
  context.axis = context.axis || word == "axis" || word == "e6axis";
  context.frame = context.frame || word == "frame" || word == "$base" || word == "$tool" || word == "$load" ||
                  word == "tool_data" || word == "base_data" || word == "$world" || word == "$robroot";
  context.motion = context.motion || std::find(kMotions.begin(), kMotions.end(), word) != kMotions.end();
  context.relative = context.relative || word.ends_with("_rel");
}

/// An aggregate's component: its name, in small letters, and its value.
struct Component {
  std::string name;
  BracketItem value;
};

class KrlReader {
 public:
  explicit KrlReader(const ReaderInput& input)
      : text_(input.source, {.comment = ';', .line = '&'}),
        arm_(input.arm),
        controller_(input.controller),
        rails_(rails_of(input.arm, input.source.file(), "KRL")),
        poses_(krl_declared_poses(text_)) {}

  Program read() {
    const std::string_view code = text_.code();
    for (std::size_t at = 0; at < code.size(); ++at) {
      if (code[at] != '{') continue;
      const BracketItem list = read_list(text_, at, '{');
      std::string name;
      const Context context = context_before(at, name);
      aggregate(list, context, name, 1);
      at += list.size - 1;
    }
    KrlFrames frames(text_, controller_);
    frames.take_points(program_.targets);
    for (Target& target : program_.targets) {
      const std::string carried = std::exchange(target.frames.unknown_frame, "");
      frames.complete(target);
      if (!carried.empty()) target.frames.unknown_frame = carried;
      if (rails_ > 0 && target.is_pose() && target.frames.frame == kKrlRobotRoot)
        target.frames.unknown_frame = "$ROBROOT may move along with the rail";
    }
    const KrlStatements statements(text_, program_);
    frames.note_routines(program_);
    return std::move(program_);
  }

 private:
  /// The words of the line before `at`, and the name that is assigned to.
  Context context_before(std::size_t at, std::string& name) const {
    const std::string_view code = text_.code();
    constexpr std::size_t kFarthest = 1000;
    std::size_t begin = at == 0 ? 0 : code.rfind('\n', at - 1) + 1;
    begin = std::max(begin, std::max(at, kFarthest) - kFarthest);
    Context context;
    while (begin < at) {
      if (!text_.begins_word(begin)) {
        ++begin;
        continue;
      }
      const std::size_t end = text_.word_end(begin);
      take_word(lower_case(code.substr(begin, end - begin)), context);
      std::size_t after = text_.skip_spaces(end), name_end = end;
      if (after < at && code[after] == '[') {
        name_end = std::min(code.find(']', after), at - 1) + 1;
        after = text_.skip_spaces(name_end);
      }
      if (after < at && code[after] == '=') name = std::string(code.substr(begin, name_end - begin));
      context.motion = context.motion || (!name.empty() && poses_.contains(krl_point_name(name).first));
      begin = end;
    }
    return context;
  }

  void aggregate(const BracketItem& list, Context context, const std::string& name, int depth) {
    if (depth > kDeepestAggregate) text_.fail(list.begin, 1, "is nested too deeply");
    std::vector<Component> components;
    for (std::size_t i = 0; i < list.items.size(); ++i) {
      const BracketItem& item = list.items[i];
      if (item.is_list)
        aggregate(item, context, name, depth + 1);
      else
        take_component(item, context, name, i == 0, depth, components);
    }
    make_target(list, context, name, components);
  }

  /// Splits "TYPE: NAME value" into its parts; a value in braces is an aggregate of its own.
  void take_component(const BracketItem& item, Context& context, const std::string& name, bool first, int depth,
                      std::vector<Component>& components) {
    const std::string_view code = text_.code();
    const std::size_t end = item.begin + item.size;
    std::size_t begin = item.begin;
    const std::size_t colon = code.substr(0, end).find(':', begin);
    if (first && colon != std::string_view::npos && text_.skip_spaces(text_.word_end(begin)) == colon) {
      context = {.relative = context.relative};
      take_word(lower_case(code.substr(begin, text_.word_end(begin) - begin)), context);
      begin = std::min(text_.skip_spaces(colon + 1), end);
    }
    const std::size_t word = std::min(text_.word_end(begin), end);
    std::size_t value = word;
    const std::string_view value_text = text_.trimmed(value, end);
    if (value_text.starts_with('{')) {
      aggregate(read_list(text_, value, '{'), {}, name, depth + 1);
    } else {
      components.push_back({lower_case(code.substr(begin, word - begin)), {value, value_text.size(), false, {}}});
    }
  }

  static const Component* find(const std::vector<Component>& components, std::string_view name) {
    const auto found = std::ranges::find(components, name, &Component::name);
    return found == components.end() ? nullptr : &*found;
  }

  /// The values of these components, as far as they are there.
  static std::vector<BracketItem> values(const std::vector<Component>& components,
                                         std::span<const std::string_view> names) {
    std::vector<BracketItem> found;
    for (const std::string_view name : names)
      if (const Component* part = find(components, name)) found.push_back(part->value);
    return found;
  }

  void make_target(const BracketItem& list, const Context& context, const std::string& name,
                   const std::vector<Component>& components) {
    if (context.relative) return;
    Target target{.name = name, .place = text_.place(list.begin)};
    const Numbers numbers = context.declared() ? Numbers::required : Numbers::or_expressions;
    const std::vector<BracketItem> axes = values(components, kAxisComponents), parts = values(components, kPoseParts);
    const bool stated = find(components, "s") != nullptr || find(components, "t") != nullptr;
    if (axes.size() == kAxisComponents.size()) {
      if (take_rails(target, components, numbers)) axis_target(target, axes, numbers);
    } else if (!axes.empty() && (context.axis || context.motion)) {
      skip_target(program_, target, "it names only some of A1 to A6");
    } else if (context.frame || !(context.pose || context.motion || stated)) {
      return;
    } else if (parts.size() == kPoseParts.size()) {
      if (take_rails(target, components, numbers)) pose_target(target, parts, components, numbers);
    } else if (!parts.empty()) {
      skip_target(program_, target, "it names only some of X, Y, Z, A, B and C");
    }
  }

  /// Where the rails stand; false, and a remark, where that is not told.
  bool take_rails(Target& target, const std::vector<Component>& components, Numbers numbers) {
    const std::vector<CellUnit> units = joint_units(arm_);
    for (int rail = 0; rail < rails_; ++rail) {
      const std::string name = "E" + std::to_string(rail + 1);
      const Component* part = find(components, lower_case(name));
      if (part == nullptr) {
        skip_target(program_, target, "it does not name " + name + ", where the rail that carries the arm is to stand");
        return false;
      }
      const auto cells =
          cells_of(text_, {&part->value, 1}, {&units[static_cast<std::size_t>(rail)], 1}, numbers, program_, target);
      if (!cells) return false;
      target.carried.push_back(cells->front());
    }
    return true;
  }

  void axis_target(Target& target, const std::vector<BracketItem>& axes, Numbers numbers) {
    const auto cells = cells_of(text_, axes, joint_units(arm_, rails_), numbers, program_, target);
    if (!cells) return;
    target.joints = *cells;
    program_.targets.push_back(std::move(target));
  }

  void pose_target(Target& target, const std::vector<BracketItem>& parts, const std::vector<Component>& components,
                   Numbers numbers) {
    constexpr CellUnit kAngle{std::numbers::pi / 180.0, kDecimalsDeg};
    constexpr std::array<CellUnit, 6> kUnits{kMillimetres, kMillimetres, kMillimetres, kAngle, kAngle, kAngle};
    const auto cells = cells_of(text_, parts, kUnits, numbers, program_, target);
    if (!cells) return;
    target.position.assign(cells->begin(), cells->begin() + 3);
    target.orientation.assign(cells->begin() + 3, cells->end());
    target.form = OrientationForm::zyx_angles;
    if (const Component* turn = find(components, "t")) target.hint = signs(turn->value);
    target.frames.unknown_frame = carried_by(components);
    program_.targets.push_back(std::move(target));
  }

  /// What external axes behind the rails say of where the arm stands; empty where none has moved.
  std::string carried_by(const std::vector<Component>& components) const {
    for (const Component& part : components) {
      if (part.name.size() != 2 || part.name.front() != 'e' || !is_digit(part.name.back())) continue;
      if (part.name.back() - '0' <= rails_ && part.name.back() != '0') continue;
      const auto number = cell_at(text_.text(), part.value.begin, part.value.size, {});
      if (number && number->value == 0.0) continue;
      return std::string("an external axis, E") + part.name.back() + ", may carry the arm";
    }
    return "";
  }

  /// T: bit i is set where the angle of axis i + 1 is negative. It may be written 42 or 'B101010'.
  ArmHint signs(const BracketItem& value) const {
    std::string_view word = text_.code().substr(value.begin, value.size);
    int bits = 0;
    if (word.starts_with('\'') && word.size() > 2) {
      for (const char digit : word.substr(2))
        if (digit == '0' || digit == '1') bits = (bits * 2 + (digit - '0')) & 63;
    } else if (const auto number = cell_at(text_.text(), value.begin, value.size, {});
               number && number->value >= 0.0 && number->value < 64.0) {
      bits = static_cast<int>(number->value);
    } else {
      return {};
    }
    ArmHint hint;
    hint.negative.resize(static_cast<std::size_t>(rails_));
    for (int joint = 0; joint < arm_.size() - rails_; ++joint) hint.negative.emplace_back(((bits >> joint) & 1) != 0);
    return hint;
  }

  ProgramText text_;
  const Chain& arm_;
  const ControllerData& controller_;
  int rails_;
  std::set<std::string> poses_;  ///< that are declared as such
  Program program_;
};

std::string krl_text(std::span<const ProgrammedStop> stops, const Chain& arm) {
  std::string text = "DEF measure( )\n";
  for (const ProgrammedStop& stop : stops) {
    const auto carried = carried_stop(arm, stop.joints);
    if (!carried) return {};
    std::string axes = joints_text(carried->arm, carried->joints, ",", numbered_names("A", carried->arm.size()));
    int rail = 0;
    for (const std::string& place : rail_texts(*carried)) axes += ",E" + std::to_string(++rail) + ' ' + place;
    text += "  PTP {" + axes + "} ; " + stop.name + '\n';
    if (stop.waits) text += "  HALT\n";
  }
  return text + "END\n";
}

}  // namespace

Language krl_language() {
  return {.name = "krl",
          .title = "KUKA KRL",
          .file_endings = {"src", "krl"},
          .signs = {"e6pos", "e6axis", "defdat", "&access", "ptp {", "lin {"},
          .comment = ";",
          .headers = {"def ", "defdat", "deffct", "global def"},
          .payload_statements = {{"$load=", stated_load_kg},
                                 {"$load.", changed_load_kg},
                                 {"bas(#tool,", selected_load_kg},
                                 {"bas (#tool,", selected_load_kg},
                                 {"fdat_act=", inline_load_kg}},
          .of_several_files = true,
          .companions = {{"src", "dat"}, {"dat", "src"}},
          .read = [](const ReaderInput& input) { return KrlReader(input).read(); },
          .write = krl_text};
}

}  // namespace demecal::inline kuka_abb_ur
