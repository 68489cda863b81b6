#include <set>
#include <sstream>

#include "fitting/fit.hpp"

namespace demecal {
namespace {

using Kind = ParameterId::Kind;

void add_axes(std::vector<ParameterId>& ids, Kind kind, const std::string& target) {
  for (int axis = 0; axis < 3; ++axis) ids.push_back({kind, axis, LinkParameter::theta, target});
}

void add_link(std::vector<ParameterId>& ids, int joint, LinkParameter parameter) {
  ids.push_back({Kind::link, joint, parameter, {}});
}

/// Whether link `link` leads between near-parallel axes: its common normal has no certain place along them.
bool between_parallels(const Chain& chain, int link, double tolerance_rad) {
  const int before = chain.convention == Convention::standard_dh ? link : link - 1;
  return near_parallel_to_next(chain, before, tolerance_rad);
}

/// A revolute joint's geometry. Between near-parallel axes beta takes the place of d, unless the d it would be lumped
/// with is not free: that of a prismatic neighbour whose offset is not declared.
void add_revolute(std::vector<ParameterId>& ids, const Chain& chain, int joint, bool parallel, bool offsets) {
  const int neighbour = chain.convention == Convention::standard_dh ? joint + 1 : joint - 1;
  const bool lumped =
      parallel && (offsets || chain.joints[static_cast<std::size_t>(neighbour)].type == JointType::revolute);
  if (!lumped) add_link(ids, joint, LinkParameter::d);
  add_link(ids, joint, LinkParameter::a);
  add_link(ids, joint, LinkParameter::alpha);
  if (parallel) add_link(ids, joint, LinkParameter::beta);
}

/// A prismatic joint has a direction but no place: two angles. About a near-parallel neighbour theta would only repeat
/// that joint's own, and beta takes its place.
void add_prismatic(std::vector<ParameterId>& ids, int joint, bool parallel) {
  add_link(ids, joint, parallel ? LinkParameter::beta : LinkParameter::theta);
  add_link(ids, joint, LinkParameter::alpha);
}

void add_links(std::vector<ParameterId>& ids, const Chain& chain, const DeclaredModel& declared,
               double near_parallel_rad) {
  for (int joint = 0; joint < chain.size(); ++joint) {
    const bool revolute = chain.joints[static_cast<std::size_t>(joint)].type == JointType::revolute;
    const bool parallel = between_parallels(chain, joint, near_parallel_rad);
    if (declared.joint_offset) add_link(ids, joint, revolute ? LinkParameter::theta : LinkParameter::d);
    if (declared.geometry && revolute) add_revolute(ids, chain, joint, parallel, declared.joint_offset);
    if (declared.geometry && !revolute) add_prismatic(ids, joint, parallel);
  }
}

void add_tools(std::vector<ParameterId>& ids, const DataSet& data) {
  std::set<std::string> targets, turned;
  for (const MeasuredPose& pose : data.poses) {
    targets.insert(pose.target);
    if (pose.orientation) turned.insert(pose.target);
  }
  for (const std::string& target : targets) {
    add_axes(ids, Kind::tool_translation, target);
    if (turned.contains(target)) add_axes(ids, Kind::tool_rotation, target);
  }
}

/// "gear_harmonic joint 2 (ratio 107)": which law, where, with which settings.
std::string effect_name(const Effect& effect) {
  std::ostringstream name;
  name << effect.kind;
  if (effect.joint >= 0) name << " joint " << effect.joint + 1;
  const char* before = " (";
  for (const auto& [setting, value] : effect.settings) {
    name << before << setting << ' ' << value;
    before = ", ";
  }
  if (!effect.settings.empty()) name << ')';
  return name.str();
}

}  // namespace

std::vector<ParameterId> effect_parameters(const CorrectedRobot& robot) {
  std::vector<ParameterId> ids;
  for (std::size_t i = 0; i < robot.effects.size(); ++i) {
    const Effect& effect = robot.effects[i];
    int coefficient = 0;
    for (const CoefficientLabel& label : law_of(effect).coefficients(effect, robot.described)) {
      ids.push_back({.kind = Kind::effect,
                     .index = static_cast<int>(i),
                     .coefficient = coefficient++,
                     .effect = effect_name(effect) + ' ' + label.name});
    }
  }
  return ids;
}

std::vector<ParameterId> free_parameters(const DataSet& data, const DeclaredModel& declared,
                                         const FitOptions& options) {
  std::vector<ParameterId> ids;
  if (declared.registration) {
    add_axes(ids, Kind::base_translation, {});
    add_axes(ids, Kind::base_rotation, {});
  }
  add_links(ids, data.robot.chain, declared, options.near_parallel_rad);
  if (declared.tool) add_tools(ids, data);
  return ids;
}

}  // namespace demecal
