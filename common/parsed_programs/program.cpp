#include "parsed_programs/program.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <functional>
#include <iterator>
#include <numbers>
#include <string_view>
#include <utility>

#include "data/text.hpp"
#include "errors/check.hpp"
#include "errors/input_error.hpp"

namespace demecal::inline parsed_programs {
namespace {

bool same_tool(const StatedFrames& one, const StatedFrames& other) {
  if (one.unknown_tool != other.unknown_tool || one.tool.has_value() != other.tool.has_value()) return false;
  return !one.tool || one.tool->isApprox(*other.tool, 1e-9);
}

bool same_frame(const StatedFrames& one, const StatedFrames& other) {
  return one.unknown_frame == other.unknown_frame && one.base_from_frame.isApprox(other.base_from_frame, 1e-9);
}

}  // namespace

std::vector<double> inside(const std::vector<Cell>& cells) {
  std::vector<double> values;
  for (const Cell& cell : cells) values.push_back(cell.inside());
  return values;
}

JointVector stated_joints(const Target& target) {
  JointVector joints(std::ssize(target.carried) + std::ssize(target.joints));
  Eigen::Index joint = 0;
  for (const std::vector<Cell>* const cells : {&target.carried, &target.joints}) {
    for (const Cell& cell : *cells) joints[joint++] = cell.inside();
  }
  return joints;
}

Eigen::Matrix3d tool_axes(const Target& target) {
  if (!target.frames.tool) return Eigen::Matrix3d::Identity();
  return target.frames.tool->linear();
}

std::size_t Program::file_at(std::size_t offset) const {
  const auto begins_by = [&](const FurtherFile& other) { return other.begin <= offset; };
  return static_cast<std::size_t>(std::count_if(further.begin(), further.end(), begins_by));
}

bool keeps_orientation(const Target& target) {
  return target.form == OrientationForm::columns || target.form == OrientationForm::unknown;
}

Eigen::Vector3d stated_point(const Target& target) {
  return target.frames.base_from_frame *
         Eigen::Vector3d(target.position[0].inside(), target.position[1].inside(), target.position[2].inside());
}

NearPlace place_before(std::optional<double> distance_mm) {
  if (!distance_mm) return {};
  return {.shift_m = Eigen::Vector3d(0.0, 0.0, -1e-3 * *distance_mm)};
}

Eigen::Matrix3d stated_axes(const Target& target, bool of_tool) {
  const Eigen::Matrix3d frame = target.frames.base_from_frame.linear();
  return of_tool ? frame * rotation_from(target.form, inside(target.orientation)) : frame;
}

Eigen::Isometry3d stated_tool_pose(const Target& target) {
  Eigen::Isometry3d tool(stated_axes(target, true) * tool_axes(target).transpose());
  tool.translation() = stated_point(target);
  return tool;
}

ApproachSigns approach_of(const Target& target, const ApproachSigns& motions) {
  ApproachSigns signs = target.approach.value_or(motions);
  for (Eigen::Index i = 0; i < signs.size(); ++i) {
    if (std::isnan(signs[i])) signs[i] = motions[i];
  }
  return signs;
}

std::vector<CellUnit> joint_units(const Chain& arm, int first) {
  std::vector<CellUnit> units;
  for (int joint = first; joint < arm.size(); ++joint) {
    units.push_back(!is_revolute(arm, joint) ? kMillimetres : CellUnit{std::numbers::pi / 180.0, kDecimalsDeg});
  }
  return units;
}

KnownFrame KnownFrame::computed(const std::string& what) {
  return {what, Eigen::Isometry3d::Identity(), what + " is computed when the program runs"};
}

void set_tool(StatedFrames& frames, const KnownFrame& tool) {
  frames.tool_name = tool.name;
  frames.unknown_tool = tool.unknown;
  frames.tool.reset();
  if (tool.unknown.empty()) frames.tool = tool.pose;
}

void set_frame(StatedFrames& frames, const KnownFrame& frame) {
  frames.frame = frame.name;
  frames.unknown_frame = frame.unknown;
  frames.base_from_frame = frame.pose;
}

void take_uses(const std::vector<TargetUse>& uses, Target& target) {
  const auto first = std::ranges::min_element(
      uses, {}, [](const TargetUse& use) { return std::pair(use.near.has_value(), use.begin); });
  target.order = first->begin;
  target.frames = first->frames;
  target.motion = Motion::line;
  target.further_motions.clear();
  target.near_motions.clear();
  for (const TargetUse& use : uses) {
    if (use.near) {
      target.near_motions[use.begin] = *use.near;
      target.near_motions[use.begin].motion = use.motion;
    } else if (use.begin != first->begin) {
      target.further_motions.push_back(use.begin);
    }
    const bool ends_elsewhere = use.near && first->near;
    if (ends_elsewhere || (!use.near && use.motion == Motion::joints)) target.motion = Motion::joints;
    if (!same_tool(use.frames, first->frames)) {
      target.frames.unknown_tool = "it is moved to with different tools";
      target.frames.several_tools = true;
    }
    if (!same_frame(use.frames, first->frames)) target.frames.unknown_frame = "it is moved to in different frames";
  }
}

void skip_target(Program& program, const Target& target, const std::string& why) {
  program.uncorrected.push_back({target.place, target.name, why + "; it is left as it is"});
}

void note_unknown_motion(Program& program, std::size_t begin, const Target& target, const std::string& why) {
  program.joints_lost_at.push_back(begin);
  skip_target(program, target, why);
}

void end_at_motions_to(const Target& target, Program& program) {
  program.joints_lost_at.push_back(target.order);
  program.joints_lost_at.insert(program.joints_lost_at.end(), target.further_motions.begin(),
                                target.further_motions.end());
  for (const auto& [begin, place] : target.near_motions) program.joints_lost_at.push_back(begin);
}

void note_offset(Program& program, const TextPlace& place, const std::string& name, std::optional<double> distance_mm) {
  if (distance_mm && std::abs(*distance_mm) <= kCloseToPoint_mm) return;
  const std::string where = distance_mm
                                ? "a place " + std::to_string(std::lround(std::abs(*distance_mm))) + " mm away from it"
                                : "a place at a distance from it that is not known";
  program.remarks.push_back(
      {place, name, where + " is given the correction of this point, which need not be right there"});
}

std::optional<std::vector<Cell>> cells_of(const ProgramText& text, std::span<const BracketItem> items,
                                          std::span<const CellUnit> units, Numbers numbers, Program& program,
                                          const Target& target) {
  DEMECAL_CHECK(items.size() == units.size(), items.size() << " items, " << units.size() << " units");
  std::vector<Cell> cells;
  for (std::size_t i = 0; i < items.size(); ++i) {
    const std::string_view word = text.code().substr(items[i].begin, items[i].size);
    if (numbers == Numbers::or_expressions && is_expression(word)) {
      skip_target(program, target, "'" + std::string(word) + "' is no number");
      return std::nullopt;
    }
    cells.push_back(text.number(items[i].begin, items[i].size, units[i]));
  }
  return cells;
}

void require_quaternion(const ProgramText& text, std::span<const Cell> cells) {
  constexpr double kRounding = 0.01;
  double square = 0.0;
  for (const Cell& cell : cells) square += cell.value * cell.value;
  if (std::abs(std::sqrt(square) - 1.0) < kRounding) return;
  const Cell &first = cells.front(), &last = cells.back();
  text.fail(first.begin, last.begin + last.size - first.begin, "must be a unit quaternion");
}

void require_six_joints(const Chain& arm, const std::string& file, const std::string& language) {
  if (arm.size() == 6) return;
  throw InputError(
      {file, 0}, "",
      "is a program in " + language + ", whose arms have 6 joints; the model's has " + std::to_string(arm.size()));
}

int rails_of(const Chain& arm, const std::string& file, const std::string& language) {
  constexpr int kSix = 6;
  int rails = 0;
  while (rails < arm.size() - kSix && !is_revolute(arm, rails)) ++rails;
  if (arm.size() - rails == kSix) return rails;
  throw InputError({file, 0}, "",
                   "is a program in " + language +
                       ", whose arms have 6 joints, and rails that carry them before those; the model's has " +
                       std::to_string(arm.size()) + " joints, of which the first " + std::to_string(rails) + " slide");
}

namespace {

KnownFrame kept(const std::map<std::string, Eigen::Isometry3d>& frames, std::string_view key, const std::string& name) {
  const auto found = frames.find(lower_case(key));
  if (found != frames.end()) return {name, found->second, ""};
  return {name, Eigen::Isometry3d::Identity(), name + " is given neither in this program nor by --frames"};
}

}  // namespace

KnownFrame ControllerData::frame(std::string_view key, const std::string& name) const {
  return kept(frames, key, name);
}

KnownFrame ControllerData::tool(std::string_view key, const std::string& name) const {
  return kept(tools, key, name);
}

}  // namespace demecal::inline parsed_programs
