// Staubli VAL3: jointRx (degrees) and pointRx (mm, and turns about x, the new y and the new z) of data files (.dtx). A
// point hangs on a frame of the data, or on the world, which is the arm's base. Programs (.pgx) tell the tools.
#include <Eigen/Core>
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

#include "kinematics/chain.hpp"
#include "parsed_programs/language.hpp"
#include "parsed_programs/orientation.hpp"
#include "parsed_programs/program.hpp"
#include "parsed_programs/program_text.hpp"
#include "staubli_kawasaki/val3_program.hpp"
#include "staubli_kawasaki/val3_way.hpp"

namespace demecal::inline staubli_kawasaki {
namespace {

constexpr std::array<std::string_view, 6> kJointAttributes{"j1", "j2", "j3", "j4", "j5", "j6"};
constexpr std::array<std::string_view, 6> kPointAttributes{"x", "y", "z", "rx", "ry", "rz"};
constexpr CellUnit kOwnAngle{std::numbers::pi / 180.0, kDecimalsDeg};
const std::vector<CellUnit> kPointUnits{kMillimetres, kMillimetres, kMillimetres, kOwnAngle, kOwnAngle, kOwnAngle};
constexpr int kDeepestFrame = 20;

bool is_world(const std::string& father) {
  return father.empty() || father == "world[0]";
}

class Val3Reader {
 public:
  explicit Val3Reader(const ReaderInput& input)
      : text_(input.source, {}),
        arm_(input.arm),
        controller_(input.controller),
        values_(val3_values(text_)),
        inches_(val3_inches(text_, controller_)),
        statements_(text_) {
    require_six_joints(input.arm, input.source.file(), "VAL3");
    for (const Val3Value& value : values_) {
      if (value.type == "frame") frames_[value.name].push_back(&value);
      if (value.type == "tool") tools_[value.name].push_back(&value);
    }
  }

  Program read() {
    for (const auto& [begin, what] : statements_.computed())
      note_unknown_motion(program_, begin, {.name = "", .place = text_.place(begin)},
                          "a motion goes to '" + what + "', which is computed when the program runs");
    say_what_is_not_given();
    note_what_is_nearby();
    note_calls();
    for (const Val3Value& value : values_) {
      const bool of_joints = value.type == "jointRx";
      if (!of_joints && value.type != "pointRx") continue;
      Target target{.name = value.name, .place = text_.place(value.begin)};
      const auto cells = of_joints ? numbers(value, kJointAttributes, joint_units(arm_), target)
                                   : numbers(value, kPointAttributes, kPointUnits, target);
      const std::string why = of_joints || inches_.empty() ? statements_.changed(value.name) : inches_;
      if (cells && !why.empty()) skip_target(program_, target, why);
      for (const Val3Motion& motion : statements_.motions(value.name))
        if (!cells || !why.empty()) program_.joints_lost_at.push_back(motion.begin);
      if (!cells || !why.empty()) continue;
      of_joints ? static_cast<void>(target.joints = *cells) : take_point(value, *cells, target);
      take_motions(value, target);
      program_.targets.push_back(std::move(target));
    }
    note_arrivals();
    return std::move(program_);
  }

 private:
  void note_arrivals() {
    Val3Way way;
    for (const Val3Code& code : val3_programs(text_))
      way.read(statements_.code(), code, text_.source().file_at(code.begin));
    way.finish();
    way.note_arrivals(program_);
  }

  void note_what_is_nearby() {
    for (const Val3Nearby& nearby : statements_.nearby()) {
      const auto shift_m = shift_of(nearby);
      const auto distance_mm = shift_m ? std::optional(1e3 * shift_m->norm()) : std::nullopt;
      note_offset(program_, text_.place(nearby.begin), nearby.name, distance_mm);
    }
  }

  /// Where the motion goes near the value and not to it.
  std::optional<NearPlace> near_place(const Val3Motion& motion, const std::string& name) const {
    for (const Val3Nearby& nearby : statements_.nearby()) {
      if (nearby.begin != motion.begin || (nearby.name != name && nearby.name != name.substr(0, name.find('['))))
        continue;
      return nearby.along_tool ? NearPlace{.shift_m = shift_of(nearby)} : NearPlace{};
    }
    return std::nullopt;
  }

  /// What the offset, or the value of the data that it is, displaces by; nothing where that turns, is not given or is
  /// changed.
  std::optional<Eigen::Vector3d> shift_of(const Val3Nearby& nearby) const {
    if (nearby.offset.empty()) return nearby.shift_m;
    const auto value = std::ranges::find_if(
        values_, [&](const Val3Value& one) { return one.type == "trsf" && one.name == nearby.offset; });
    if (value == values_.end() || !statements_.changed(nearby.offset).empty()) return std::nullopt;
    const auto pose = transform(*value);
    if (!pose || !pose->linear().isApprox(Eigen::Matrix3d::Identity(), 1e-9)) return std::nullopt;
    return Eigen::Vector3d(pose->translation());
  }

  /// Says once which programs may change the data, and are not here.
  void note_calls() {
    std::vector<std::string> names;
    for (const auto& [begin, name] : statements_.calls_elsewhere())
      if (std::ranges::find(names, name) == names.end()) names.push_back(name);
    if (names.empty()) return;
    constexpr std::size_t kNamed = 3;
    std::string list = names.front();
    for (std::size_t i = 1; i < std::min(names.size(), kNamed); ++i) list += ", " + names[i];
    if (names.size() > kNamed) list += " and " + std::to_string(names.size() - kNamed) + " more";
    program_.remarks.push_back({text_.place(statements_.calls_elsewhere().begin()->first), "",
                                "the programs that are called, " + list +
                                    ", are not in the files given: points, frames and tools are taken as the data have "
                                    "them, and the arm to be where it was; --with FILE takes programs in"});
  }

  /// Says where programs move to values that no data file gives.
  void say_what_is_not_given() {
    std::set<std::string> given;
    for (const Val3Value& value : values_) {
      given.insert(value.name);
      given.insert(value.name.substr(0, value.name.find('[')));
    }
    for (const auto& [name, motions] : statements_.motions()) {
      const bool is_given = given.contains(name), one = name.find('[') != std::string::npos;
      for (const Val3Motion& motion : motions) {
        if (!is_given)
          note_unknown_motion(program_, motion.begin, {.name = name, .place = text_.place(motion.begin)},
                              "it is not given in this program");
        if (is_given && !one) program_.joints_lost_at.push_back(motion.begin);
      }
    }
  }

  /// The tools and the order of the motions to the target; without any, the only tool there is.
  void take_motions(const Val3Value& value, Target& target) const {
    target.order = value.begin;
    std::vector<TargetUse> uses;
    for (const Val3Motion& motion : statements_.motions(value.name)) {
      TargetUse use{motion.begin, motion.motion, target.frames};
      set_tool(use.frames, motion.tool.empty() ? KnownFrame::computed("the motion's tool") : tool(motion.tool));
      use.near = near_place(motion, value.name);
      uses.push_back(std::move(use));
    }
    if (!uses.empty()) return take_uses(uses, target);
    if (!tools_.empty()) set_tool(target.frames, only_tool());
  }

  /// The numbers of these attributes, in the order of the names; nothing, and a remark, where some are left out.
  std::optional<std::vector<Cell>> numbers(const Val3Value& value, std::span<const std::string_view> names,
                                           const std::vector<CellUnit>& units, const Target& target) {
    std::vector<Cell> cells;
    std::string missing;
    for (std::size_t i = 0; i < names.size(); ++i) {
      const auto found = value.attributes.find(std::string(names[i]));
      if (found == value.attributes.end())
        missing += (missing.empty() ? "" : ", ") + std::string(names[i]);
      else
        cells.push_back(text_.number(found->second.begin, found->second.size, units[i]));
    }
    if (missing.empty()) return cells;
    skip_target(program_, target,
                "it leaves out " + missing + "; write 0 where that is meant, so that it can be changed");
    return std::nullopt;
  }

  void take_point(const Val3Value& value, const std::vector<Cell>& cells, Target& target) const {
    target.position.assign(cells.begin(), cells.begin() + 3);
    target.orientation.assign(cells.begin() + 3, cells.end());
    target.form = OrientationForm::xyz_angles;
    target.hint = configuration(value);
    const std::string father = word(value, "fatherId");
    if (!is_world(father)) set_frame(target.frames, frame(father, 0));
  }

  std::string word(const Val3Value& value, const std::string& attribute) const {
    const auto found = value.attributes.find(attribute);
    if (found == value.attributes.end()) return "";
    return std::string(text_.text().substr(found->second.begin, found->second.size));
  }

  /// "lefty epositive wpositive"; each part by itself where one of them is the one before, or any.
  ArmHint configuration(const Val3Value& value) const {
    ArmHint all, each;
    bool whole = true, stated = false;
    for (const char* part : {"shoulder", "elbow", "wrist"}) {
      const std::string said = word(value, part);
      const bool kept = said.ends_with("same"), any = said.empty() || said.ends_with("free");
      each.parts.push_back({kept || any ? "" : said, kept});
      all.configuration += (all.configuration.empty() ? "" : " ") + said;
      whole = whole && !kept && !any;
      stated = stated || !any;
    }
    return whole ? all : stated ? each : ArmHint{};
  }

  /// The transform of a frame or tool to what it hangs on; what is left out is 0.
  std::optional<Eigen::Isometry3d> transform(const Val3Value& value) const {
    std::array<double, 6> inside{};
    for (std::size_t i = 0; i < inside.size(); ++i) {
      const auto found = value.attributes.find(std::string(kPointAttributes[i]));
      if (found == value.attributes.end()) continue;
      const auto cell = cell_at(text_.text(), found->second.begin, found->second.size, kPointUnits[i]);
      if (!cell) return std::nullopt;
      inside[i] = cell->inside();
    }
    Eigen::Isometry3d pose(rotation_from(OrientationForm::xyz_angles, {inside[3], inside[4], inside[5]}));
    pose.translation() = Eigen::Vector3d(inside[0], inside[1], inside[2]);
    return pose;
  }

  /// What of this name `declared` has, if it is one value that no program changes.
  KnownFrame declared(const std::map<std::string, std::vector<const Val3Value*>>& values, const std::string& name,
                      const std::string& what) const {
    const std::vector<const Val3Value*>& found = values.at(name);
    const std::string changed = statements_.changed(name);
    const auto pose = transform(*found.front());
    if (!pose) return KnownFrame::computed(what);
    return {name, *pose,
            found.size() > 1   ? what + " is given more than once"
            : !changed.empty() ? what + " is not known: " + changed
                               : ""};
  }

  KnownFrame frame(const std::string& name, int depth) const {
    if (!frames_.contains(name)) return controller_.frame(name, "frame " + name);
    KnownFrame own = declared(frames_, name, "frame " + name);
    const std::string father = word(*frames_.at(name).front(), "fatherId");
    if (is_world(father) || !own.unknown.empty()) return own;
    if (depth > kDeepestFrame) return KnownFrame::computed("frame " + name);
    const KnownFrame below = frame(father, depth + 1);
    return {name, below.pose * own.pose, below.unknown};
  }

  KnownFrame tool(const std::string& name) const {
    if (name == "flange[0]") return {"flange", Eigen::Isometry3d::Identity(), ""};
    if (!inches_.empty()) return {name, Eigen::Isometry3d::Identity(), inches_};
    if (!tools_.contains(name)) return controller_.tool(name, "tool " + name);
    const std::string father = word(*tools_.at(name).front(), "fatherId");
    if (!father.empty() && father != "flange[0]") return KnownFrame::computed("tool " + name);
    return declared(tools_, name, "tool " + name);
  }

  /// The tool of what no motion goes to: the only one, for which is meant stands in programs.
  KnownFrame only_tool() const {
    if (tools_.size() == 1) return tool(tools_.begin()->first);
    return {"tool", Eigen::Isometry3d::Identity(),
            statements_.any() ? "there are several tools, and no motion tells which is meant"
                              : "the file has several tools, and which is meant stands in the program"};
  }

  ProgramText text_;
  const Chain& arm_;
  const ControllerData& controller_;
  Program program_;
  std::vector<Val3Value> values_;
  std::string inches_;  ///< why lengths are not millimetres; empty: they are
  Val3Statements statements_;
  std::map<std::string, std::vector<const Val3Value*>> frames_, tools_;
};

}  // namespace

Language val3_language() {
  return {.name = "val3",
          .title = "Staubli VAL3",
          .file_endings = {"dtx", "pgx"},
          .signs = {"val3/data", "val3/program"},
          .comment = "<!--",
          .comment_end = " -->",
          .headers = {"<?xml"},
          .of_several_files = true,
          .application_ending = "pjx",
          .read = [](const ReaderInput& input) { return Val3Reader(input).read(); },
          .write = val3_written_data,
          .written_beside = "pgx",
          .write_beside = val3_written_program};
}

}  // namespace demecal::inline staubli_kawasaki
