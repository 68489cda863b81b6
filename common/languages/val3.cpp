// Staubli VAL3 data (.dtx): jointRx (j1 to j6 in degrees) and pointRx (x, y, z in mm and rx, ry, rz in degrees, turns
// about x, the new y and the new z). A point hangs on a frame of the file, or on the world, which is the arm's base.
// What the program text (.pgx) does with them is not read.
#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cstddef>
#include <map>
#include <numbers>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "kinematics/chain.hpp"
#include "languages/controller_data.hpp"
#include "languages/languages.hpp"
#include "languages/orientation.hpp"
#include "languages/program.hpp"
#include "languages/program_text.hpp"
#include "languages/val3_data.hpp"

namespace demecal::inline languages {
namespace {

constexpr std::array<std::string_view, 6> kJointAttributes{"j1", "j2", "j3", "j4", "j5", "j6"};
constexpr std::array<std::string_view, 6> kPointAttributes{"x", "y", "z", "rx", "ry", "rz"};
constexpr CellUnit kOwnAngle{std::numbers::pi / 180.0, kDecimalsDeg};
constexpr int kDeepestFrame = 20;

class Val3Reader {
 public:
  explicit Val3Reader(const ReaderInput& input)
      : text_(input.source, {}), arm_(input.arm), controller_(input.controller), values_(val3_values(text_)) {
    require_six_joints(input.arm, input.source.file(), "VAL3");
    for (const Val3Value& value : values_) {
      if (value.type == "frame") frames_.try_emplace(value.name, &value);
      if (value.type == "tool") tools_.push_back(&value);
    }
  }

  Program read() {
    const KnownFrame tool = only_tool();
    for (const Val3Value& value : values_) {
      const bool of_joints = value.type == "jointRx";
      if (!of_joints && value.type != "pointRx") continue;
      Target target{.name = value.name, .place = text_.place(value.begin)};
      const auto cells = of_joints ? numbers(value, kJointAttributes, joint_units(arm_), target)
                                   : numbers(value, kPointAttributes, point_units(), target);
      if (!cells) continue;
      of_joints ? static_cast<void>(target.joints = *cells) : take_point(value, *cells, target);
      if (!tools_.empty()) set_tool(target.frames, tool);
      target.order = value.begin;
      program_.targets.push_back(std::move(target));
    }
    return std::move(program_);
  }

 private:
  static std::vector<CellUnit> point_units() {
    return {kMillimetres, kMillimetres, kMillimetres, kOwnAngle, kOwnAngle, kOwnAngle};
  }

  /// The numbers of these attributes, in the order of the names; nothing, and a remark, where some are left out.
  std::optional<std::vector<Cell>> numbers(const Val3Value& value, std::span<const std::string_view> names,
                                           const std::vector<CellUnit>& units, const Target& target) {
    std::vector<Cell> cells;
    std::string missing;
    for (std::size_t i = 0; i < names.size(); ++i) {
      const auto found = value.attributes.find(std::string(names[i]));
      if (found == value.attributes.end()) {
        missing += (missing.empty() ? "" : ", ") + std::string(names[i]);
      } else {
        cells.push_back(text_.number(found->second.begin, found->second.size, units[i]));
      }
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
    target.hint.configuration = configuration(value);
    const std::string father = word(value, "fatherId");
    if (!is_world(father)) set_frame(target.frames, frame(father, 0));
  }

  std::string word(const Val3Value& value, const std::string& attribute) const {
    const auto found = value.attributes.find(attribute);
    if (found == value.attributes.end()) return "";
    return std::string(text_.text().substr(found->second.begin, found->second.size));
  }

  static bool is_world(const std::string& father) { return father.empty() || father == "world[0]"; }

  /// "lefty epositive wpositive"; empty where one of them is that of the arm before, or free.
  std::string configuration(const Val3Value& value) const {
    std::string words;
    for (const char* part : {"shoulder", "elbow", "wrist"}) {
      const std::string said = word(value, part);
      if (said.empty() || said.ends_with("same") || said.ends_with("free")) return "";
      words += (words.empty() ? "" : " ") + said;
    }
    return words;
  }

  /// The transform of a frame or tool to what it hangs on; what is left out is 0.
  std::optional<Eigen::Isometry3d> transform(const Val3Value& value) const {
    std::array<double, 6> inside{};
    for (std::size_t i = 0; i < inside.size(); ++i) {
      const auto found = value.attributes.find(std::string(kPointAttributes[i]));
      if (found == value.attributes.end()) continue;
      const auto cell = cell_at(text_.text(), found->second.begin, found->second.size, point_units()[i]);
      if (!cell) return std::nullopt;
      inside[i] = cell->inside();
    }
    Eigen::Isometry3d pose(rotation_from(OrientationForm::xyz_angles, {inside[3], inside[4], inside[5]}));
    pose.translation() = Eigen::Vector3d(inside[0], inside[1], inside[2]);
    return pose;
  }

  KnownFrame frame(const std::string& name, int depth) const {
    const auto found = frames_.find(name);
    if (found == frames_.end()) return controller_.frame(name, "frame " + name);
    const auto pose = transform(*found->second);
    if (!pose || depth > kDeepestFrame)
      return {name, Eigen::Isometry3d::Identity(), "frame " + name + " is not given as numbers in this file"};
    const std::string father = word(*found->second, "fatherId");
    if (is_world(father)) return {name, *pose, ""};
    KnownFrame known = frame(father, depth + 1);
    return {name, known.pose * *pose, known.unknown};
  }

  /// The file's tool, where it is the only one: which is meant stands in the program text.
  KnownFrame only_tool() const {
    if (tools_.empty()) return {};
    const Val3Value& first = *tools_.front();
    const auto pose = transform(first);
    const std::string father = word(first, "fatherId");
    if (tools_.size() > 1)
      return {"tool", Eigen::Isometry3d::Identity(),
              "the file has several tools, and which is meant stands in the program"};
    if (!pose || (!father.empty() && father != "flange[0]")) return KnownFrame::computed("tool " + first.name);
    return {first.name, *pose, ""};
  }

  ProgramText text_;
  const Chain& arm_;
  const ControllerData& controller_;
  Program program_;
  std::vector<Val3Value> values_;
  std::map<std::string, const Val3Value*> frames_;
  std::vector<const Val3Value*> tools_;
};

}  // namespace

Language val3_language() {
  return {.name = "val3",
          .title = "Staubli VAL3 data",
          .file_endings = {"dtx"},
          .signs = {"val3/data"},
          .comment = "<!--",
          .comment_end = " -->",
          .headers = {"<?xml"},
          .read = [](const ReaderInput& input) { return Val3Reader(input).read(); }};
}

}  // namespace demecal::inline languages
