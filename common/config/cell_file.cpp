#include "config/cell_file.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cstddef>
#include <initializer_list>
#include <map>
#include <optional>
#include <string_view>
#include <vector>

#include "data/text.hpp"
#include "expression/bound.hpp"
#include "kinematics/chain.hpp"
#include "kinematics/units.hpp"
#include "planning/cell.hpp"
#include "yaml/yaml_node.hpp"

namespace demecal::inline config {
namespace {

constexpr double kHalfTurn_deg = 180.0;

Eigen::Vector3d point_m(const YamlNode& node) {
  return metres(1.0) * node.vector3();
}

Eigen::Vector3d direction(const YamlNode& node) {
  const Eigen::Vector3d vector = node.vector3();
  if (vector.isZero()) node.fail("", "must not be zero: it is a direction");
  return vector.normalized();
}

Eigen::AlignedBox3d read_box(const YamlNode& node) {
  node.with_keys({"lower", "upper"});
  const Eigen::Vector3d lower = point_m(node.at("lower")), upper = point_m(node.at("upper"));
  if ((upper - lower).minCoeff() <= 0.0) node.fail("", "must have an upper corner above the lower one along each axis");
  return {lower, upper};
}

HalfSpace read_half_space(const YamlNode& node) {
  node.with_keys({"normal", "offset_mm", "of"});
  HalfSpace space{direction(node.at("normal")), metres(node.at("offset_mm").number()), true};
  if (const YamlNode* of = node.find("of")) space.of_arm = of->one_of<bool>({{"arm", true}, {"tool_point", false}});
  return space;
}

Capsule read_obstacle(const YamlNode& node) {
  node.with_keys({"from_mm", "to_mm", "radius_mm"});
  return {point_m(node.at("from_mm")), point_m(node.at("to_mm")), metres(node.at("radius_mm").non_negative())};
}

double radius_of_arm_m(const YamlNode& node) {
  const double radius_m = metres(node.non_negative());
  if (radius_m < kLeastRadius_m)
    node.fail("must be " + number_text(millimetres(kLeastRadius_m)) +
              " mm or more, for no arm is thinner: a radius in metres has to be written in mm");
  return radius_m;
}

std::vector<double> read_radii(const YamlNode& node, const Chain& chain) {
  std::vector<double> radii(chain.joints.size() + 1);
  if (node.kind == YamlNode::Kind::scalar) {
    for (double& radius : radii) radius = radius_of_arm_m(node);
    return radii;
  }
  const auto& items = node.list(radii.size());
  for (std::size_t i = 0; i < radii.size(); ++i) radii[i] = radius_of_arm_m(items[i]);
  return radii;
}

ToolCone read_tool_cone(const YamlNode& node) {
  node.with_keys({"tool_direction", "about", "half_angle_deg"});
  return {direction(node.at("tool_direction")), direction(node.at("about")),
          radians(node.at("half_angle_deg").number(0.0, kHalfTurn_deg))};
}

Instrument read_planned_instrument(const YamlNode& node) {
  node.with_keys(
      {"position_mm", "range_mm", "target_direction", "target_half_angle_deg", "orientation", "line_of_sight"});
  Instrument instrument;
  instrument.position_m = point_m(node.at("position_mm"));
  if (const YamlNode* range = node.find("range_mm")) {
    const auto [nearest, farthest] = range->range();
    instrument.nearest_m = metres(nearest);
    instrument.farthest_m = metres(farthest);
  }
  if (const YamlNode* looks = node.find("target_direction")) {
    instrument.target_direction = direction(*looks);
    instrument.half_angle_rad = radians(node.at("target_half_angle_deg").number(0.0, kHalfTurn_deg));
  }
  if (const YamlNode* orientation = node.find("orientation")) instrument.measures_orientation = orientation->boolean();
  if (const YamlNode* sight = node.find("line_of_sight")) instrument.line_of_sight = sight->boolean();
  return instrument;
}

SocketRoom read_socket_room(const YamlNode& node) {
  node.with_keys({"box_mm", "length_mm", "length_sigma_mm"});
  SocketRoom room;
  if (const YamlNode* box = node.find("box_mm")) room.box = read_box(*box);
  if (const YamlNode* length = node.find("length_mm")) room.length_m = metres(length->positive());
  if (const YamlNode* sigma = node.find("length_sigma_mm")) {
    if (!room.length_m) sigma->fail("", "is the uncertainty of length_mm, which is not stated");
    room.length_sigma_m = metres(sigma->positive());
  }
  return room;
}

std::vector<std::optional<Interval>> read_cell_ranges(const YamlNode& node, const Chain& chain) {
  std::vector<std::string> stems, keys;
  for (int i = 1; i <= chain.size(); ++i) stems.push_back("q" + std::to_string(i));
  for (std::size_t i = 0; i < stems.size(); ++i)
    keys.push_back(stems[i] + (is_revolute(chain.joints[i]) ? "_deg" : "_mm"));
  node.with_keys(keys);
  std::vector<std::optional<Interval>> ranges(chain.joints.size());
  for (std::size_t i = 0; i < keys.size(); ++i) {
    const YamlNode* range = node.find(keys[i]);
    if (range == nullptr) continue;
    const bool turns = is_revolute(chain.joints[i]);
    const auto [lower, upper] = range->range();
    ranges[i] = turns ? Interval{radians(lower), radians(upper)} : Interval{metres(lower), metres(upper)};
    if (ranges[i]->lower < chain.joints[i].lower || ranges[i]->upper > chain.joints[i].upper)
      range->fail("", "must lie within the limits of the robot file");
  }
  return ranges;
}

/// An obstacle of a few mm at the very origin is one in metres.
void require_millimetres(const YamlNode& node, const std::vector<Capsule>& obstacles) {
  constexpr double kTiny_m = 5e-3;
  const auto is_tiny = [](const Capsule& obstacle) {
    return std::max({obstacle.from_m.cwiseAbs().maxCoeff(), obstacle.to_m.cwiseAbs().maxCoeff(), obstacle.radius_m}) <
           kTiny_m;
  };
  const auto tiny = std::ranges::find_if(obstacles, is_tiny);
  if (tiny == obstacles.end()) return;
  node.list()[static_cast<std::size_t>(tiny - obstacles.begin())].fail(
      "", "has no number of " + number_text(millimetres(kTiny_m)) + " mm or more: metres have to be written in mm");
}

std::map<Obstruction, StatedRule> stated_rules(const YamlNode& root) {
  std::map<Obstruction, StatedRule> rules;
  const auto state = [&](const char* key, std::initializer_list<Obstruction> refused) {
    const YamlNode* node = root.find(key);
    if (node == nullptr) return;
    for (const Obstruction why : refused) rules[why] = {{node->file, node->line}, key};
  };
  state("joint_ranges", {Obstruction::limits});
  state("tool_box_mm", {Obstruction::tool_box});
  state("half_spaces", {Obstruction::half_space});
  state("link_radius_mm", {Obstruction::itself});
  state("obstacles", {Obstruction::obstacle});
  state("tool_cone", {Obstruction::tool_cone});
  state("instrument", {Obstruction::range, Obstruction::target_cone, Obstruction::sight});
  return rules;
}

}  // namespace

CellFile load_cell(const std::filesystem::path& path, const Robot& robot) {
  const YamlNode root = read_yaml(path);
  root.with_version("cell", 1).with_keys({"demecal_cell", "tool_box_mm", "half_spaces", "obstacles", "link_radius_mm",
                                          "tool_cone", "instrument", "joint_ranges", "noise_mm", "tools_mm",
                                          "sockets"});
  CellFile file;
  if (const YamlNode* box = root.find("tool_box_mm")) file.cell.tool_box = read_box(*box);
  if (const YamlNode* spaces = root.find("half_spaces"))
    for (const YamlNode& space : spaces->list()) file.cell.half_spaces.push_back(read_half_space(space));
  if (const YamlNode* obstacles = root.find("obstacles")) {
    for (const YamlNode& obstacle : obstacles->list()) file.cell.obstacles.push_back(read_obstacle(obstacle));
    require_millimetres(*obstacles, file.cell.obstacles);
  }
  if (const YamlNode* radii = root.find("link_radius_mm")) file.cell.radii_m = read_radii(*radii, robot.chain);
  if (const YamlNode* cone = root.find("tool_cone")) file.cell.tool_cone = read_tool_cone(*cone);
  if (const YamlNode* instrument = root.find("instrument")) file.cell.instrument = read_planned_instrument(*instrument);
  if (const YamlNode* ranges = root.find("joint_ranges")) file.cell.ranges = read_cell_ranges(*ranges, robot.chain);
  if (const YamlNode* noise = root.find("noise_mm")) file.cell.noise_m = metres(noise->positive());
  if (const YamlNode* sockets = root.find("sockets")) file.cell.sockets = read_socket_room(*sockets);
  if (const YamlNode* tools = root.find("tools_mm"))
    for (const YamlNode& tool : tools->children) file.tools_m[tool.name] = point_m(tool);
  file.stated = stated_rules(root);
  return file;
}

}  // namespace demecal::inline config
