#include "data_files/robot_file.hpp"
#include "kinematics/chain.hpp"
#include "kinematics/drawn_arm.hpp"
#include "yaml/yaml_node.hpp"

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <numbers>
#include <optional>
#include <set>
#include <sstream>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "data/text.hpp"
#include "kinematics/units.hpp"
#include "yaml/yaml_text.hpp"

namespace demecal::inline data_files {
namespace {

constexpr double kShortestReach_m = 0.01;  // below it lengths were given in metres

enum class DrawnType { revolute, continuous, prismatic };
enum class DrawnConvention { standard_dh, modified_dh, urdf };

/// An angle of a link, rad. A right angle written in radians is the commonest slip in such tables.
double link_angle(const YamlNode& node) {
  const double angle_deg = node.number(-360.0, 360.0);
  for (const double suspect : {0.5 * std::numbers::pi, std::numbers::pi}) {
    if (std::abs(std::abs(angle_deg) - suspect) < 1e-3) node.fail("looks like radians; degrees are expected");
  }
  return radians(angle_deg);
}

double optional_angle(const YamlNode* node) {
  return node ? link_angle(*node) : 0.0;
}

Origin read_origin(const YamlNode& node) {
  Origin origin;
  if (const YamlNode* xyz = node.find("xyz_mm")) origin.xyz_m = metres(1.0) * xyz->vector3();
  if (const YamlNode* rpy = node.find("rpy_deg")) {
    const std::vector<YamlNode>& angles = rpy->list(3);
    for (int i = 0; i < 3; ++i) origin.rpy_rad[i] = link_angle(angles[static_cast<std::size_t>(i)]);
  }
  return origin;
}

Origin read_end(const YamlNode* node) {
  if (node == nullptr) return {};
  node->with_keys({"xyz_mm", "rpy_deg"});
  return read_origin(*node);
}

void read_type_and_limits(const YamlNode& node, Joint& row) {
  const auto type = node.at("type").one_of<DrawnType>(
      {{"revolute", DrawnType::revolute}, {"continuous", DrawnType::continuous}, {"prismatic", DrawnType::prismatic}});
  row.type = type == DrawnType::prismatic ? JointType::prismatic : JointType::revolute;
  const bool revolute = is_revolute(row);
  if (const YamlNode* wrong = node.find(revolute ? "limits_mm" : "limits_deg")) {
    wrong->fail("", std::string("is of the wrong unit: ") +
                        (revolute ? "a revolute joint has limits_deg" : "a prismatic joint has limits_mm"));
  }
  if (type == DrawnType::continuous) {
    if (const YamlNode* limits = node.find("limits_deg")) limits->fail("", "is not for a continuous joint");
    row.endless = true;
    row.upper = 2.0 * std::numbers::pi;
    row.lower = -row.upper;
    return;
  }
  const auto [lower, upper] = node.at(revolute ? "limits_deg" : "limits_mm").range();
  row.lower = revolute ? radians(lower) : metres(lower);
  row.upper = revolute ? radians(upper) : metres(upper);
}

constexpr std::array<std::pair<std::string_view, GearKind>, 4> kGearKinds{{{"strain_wave", GearKind::strain_wave},
                                                                           {"cycloidal", GearKind::cycloidal},
                                                                           {"planetary", GearKind::planetary},
                                                                           {"spur", GearKind::spur}}};

void read_gear(const YamlNode& node, Joint& row) {
  const YamlNode* const gear = node.find("gear");
  if (gear == nullptr) return;
  gear->with_keys({"kind", "ratio"});
  if (!is_revolute(row)) gear->fail("", "is for joints that turn: its lines are counted by the joint's turn");
  row.gear = Gear{gear->at("kind").one_of<GearKind>({kGearKinds[0], kGearKinds[1], kGearKinds[2], kGearKinds[3]}),
                  gear->at("ratio").number()};
  if (!(row.gear->ratio > 1.0))
    gear->at("ratio").fail("must be above 1: turns of the gear's input for one turn of the joint");
}

std::string gear_entry(const Joint& row) {
  if (!row.gear) return {};
  const auto kind = std::ranges::find(kGearKinds, row.gear->kind, &std::pair<std::string_view, GearKind>::second);
  return ", gear: {kind: " + std::string(kind->first) + ", ratio: " + number_text(row.gear->ratio) + "}";
}

/// Which way and from where the controller counts.
void read_counting(const YamlNode& node, DrawnJoint& joint) {
  if (const YamlNode* name = node.find("name")) joint.name = name->text();
  if (const YamlNode* direction = node.find("direction")) {
    joint.direction = static_cast<int>(direction->number());
    if (std::abs(direction->number()) != 1.0) direction->fail("must be 1 or -1");
  }
  const bool revolute = is_revolute(joint.row);
  if (const YamlNode* wrong = node.find(revolute ? "offset_mm" : "offset_deg")) {
    wrong->fail("", std::string("is of the wrong unit: ") +
                        (revolute ? "a revolute joint has offset_deg" : "a prismatic joint has offset_mm"));
  }
  if (const YamlNode* offset = node.find(revolute ? "offset_deg" : "offset_mm"))
    joint.offset = revolute ? link_angle(*offset) : metres(offset->number());
}

DrawnJoint read_row(const YamlNode& node) {
  node.with_keys({"name", "type", "alpha_deg", "a_mm", "d_mm", "theta_offset_deg", "beta_deg", "direction",
                  "offset_deg", "offset_mm", "limits_deg", "limits_mm", "gear"});
  DrawnJoint joint;
  read_type_and_limits(node, joint.row);
  read_gear(node, joint.row);
  joint.row.alpha_rad = link_angle(node.at("alpha_deg"));
  joint.row.a_m = metres(node.at("a_mm").number());
  joint.row.d_m = metres(node.at("d_mm").number());
  joint.row.theta_rad = optional_angle(node.find("theta_offset_deg"));
  joint.row.beta_rad = optional_angle(node.find("beta_deg"));
  read_counting(node, joint);
  return joint;
}

DrawnJoint read_axis(const YamlNode& node) {
  node.with_keys({"name", "type", "xyz_mm", "rpy_deg", "axis", "direction", "offset_deg", "offset_mm", "limits_deg",
                  "limits_mm", "gear"});
  DrawnJoint joint;
  read_type_and_limits(node, joint.row);
  read_gear(node, joint.row);
  joint.origin = read_origin(node);
  joint.axis = Eigen::Vector3d::UnitX();  // as URDF has it
  if (const YamlNode* axis = node.find("axis")) {
    joint.axis = axis->vector3();
    if (joint.axis.norm() < 1e-6) axis->fail("", "must not be zero: the joint turns about it or slides along it");
  }
  read_counting(node, joint);
  return joint;
}

void check_that_names_differ(const YamlNode& joints, std::set<std::string>& names) {
  for (const YamlNode& joint : joints.list()) {
    const YamlNode* name = joint.find("name");
    if (name != nullptr && !names.insert(name->text()).second)
      name->fail("is the name of two joints; names must differ");
  }
}

DrawnArm with_positioner(const YamlNode& node, const DrawnArm& arm, const Origin& workpiece) {
  if (!arm.by_axes) node.fail("", "is drawn by axes, and so must be the arm: convention: urdf");
  std::vector<DrawnJoint> axes;
  for (const YamlNode& axis : node.list()) axes.push_back(read_axis(axis));
  if (axes.empty() || axes.size() + arm.joints.size() > static_cast<std::size_t>(kMaxJoints))
    node.fail("", "must have an axis at least, and with the arm's joints from 1 to " + std::to_string(kMaxJoints));
  return behind_positioner(arm, axes, workpiece);
}

void check_reach(const YamlNode& joints, const DrawnArm& arm) {
  double reach_m = arm.flange.xyz_m.norm();
  for (const DrawnJoint& joint : arm.joints) {
    reach_m += std::abs(joint.row.a_m) + std::abs(joint.row.d_m) + joint.origin.xyz_m.norm();
    if (!is_revolute(joint.row)) reach_m += std::max(std::abs(joint.row.lower), std::abs(joint.row.upper));
  }
  if (reach_m > 0.0 && reach_m < kShortestReach_m) {
    joints.fail("", "reach less than " + number_text(millimetres(kShortestReach_m)) +
                        " mm in all; lengths are expected in millimetres and look like metres");
  }
}

std::vector<CommandCoupling> read_couplings(const YamlNode& list, const DrawnArm& arm) {
  std::vector<CommandCoupling> couplings;
  std::set<std::pair<int, int>> seen;
  const auto joints = static_cast<std::int64_t>(arm.joints.size());
  for (const YamlNode& node : list.list()) {
    node.with_keys({"joint", "from", "factor"});
    const CommandCoupling coupling{static_cast<int>(node.at("joint").whole_number(1, joints)) - 1,
                                   static_cast<int>(node.at("from").whole_number(1, joints)) - 1,
                                   node.at("factor").number()};
    if (coupling.from >= coupling.joint) node.at("from").fail("must be a joint nearer to the base than `joint`");
    const auto row = [&](int joint) -> const Joint& { return arm.joints[static_cast<std::size_t>(joint)].row; };
    if (row(coupling.from).type != row(coupling.joint).type)
      node.at("from").fail("must be a joint of the same type: both turn, or both slide");
    if (!seen.insert({coupling.joint, coupling.from}).second) node.fail("", "couples the same two joints again");
    couplings.push_back(coupling);
  }
  std::ranges::stable_sort(couplings, {}, &CommandCoupling::joint);
  return couplings;
}

bool is_bare(const DrawnJoint& joint) {
  return joint.name.empty() && !joint.row.endless && joint.direction == 1 && joint.offset == 0.0;
}

std::string limits_entry(const Joint& row) {
  if (row.endless) return {};
  const bool revolute = is_revolute(row);
  const auto limit = revolute ? degrees_text : millimetres_text;
  return std::string(revolute ? ", limits_deg: [" : ", limits_mm: [") + limit(row.lower) + ", " + limit(row.upper) +
         "]";
}

std::string rpy_text(const Eigen::Vector3d& rpy_rad) {
  std::vector<std::string> angles;
  for (const double angle : rpy_rad) angles.push_back(degrees_text(angle));
  return yaml_list(angles);
}

}  // namespace

DrawnArm read_drawing(const YamlNode& node) {
  DrawnArm arm;
  const auto convention = node.at("convention")
                              .one_of<DrawnConvention>({{"standard_dh", DrawnConvention::standard_dh},
                                                        {"modified_dh", DrawnConvention::modified_dh},
                                                        {"urdf", DrawnConvention::urdf}});
  arm.by_axes = convention == DrawnConvention::urdf;
  arm.convention = convention == DrawnConvention::standard_dh ? Convention::standard_dh : Convention::modified_dh;
  const YamlNode& joints = node.at("joints");
  if (joints.list().empty() || joints.children.size() > static_cast<std::size_t>(kMaxJoints)) {
    joints.fail("",
                "must be from 1 to " + std::to_string(kMaxJoints) + ", not " + std::to_string(joints.children.size()));
  }
  for (const YamlNode& joint : joints.children) arm.joints.push_back(arm.by_axes ? read_axis(joint) : read_row(joint));
  arm.base = read_end(node.find("base"));
  arm.flange = read_end(node.find("flange"));
  std::set<std::string> names;
  check_that_names_differ(joints, names);
  check_reach(joints, arm);
  if (const YamlNode* positioner = node.find("positioner")) {
    check_that_names_differ(*positioner, names);
    arm = with_positioner(*positioner, arm, read_end(node.find("workpiece")));
  } else if (const YamlNode* workpiece = node.find("workpiece")) {
    workpiece->fail("", "is held by a positioner: `positioner` is missing");
  }
  if (const YamlNode* couplings = node.find("couplings")) arm.couplings = read_couplings(*couplings, arm);
  return arm;
}

bool is_more_than_rows(const DrawnArm& arm) {
  return arm.by_axes || !arm.couplings.empty() || arm.base != Origin{} || arm.flange != Origin{} ||
         !std::ranges::all_of(arm.joints, is_bare);
}

std::string joint_text(const DrawnArm& arm, const DrawnJoint& joint) {
  const bool revolute = is_revolute(joint.row);
  std::ostringstream text;
  text << "{" << (joint.name.empty() ? "" : "name: " + yaml_text(joint.name) + ", ") << "type: "
       << (joint.row.endless ? "continuous"
           : revolute        ? "revolute"
                             : "prismatic");
  if (arm.by_axes) {
    text << ", xyz_mm: " << yaml_mm(joint.origin.xyz_m) << ", rpy_deg: " << rpy_text(joint.origin.rpy_rad)
         << ", axis: " << yaml_numbers({joint.axis.data(), 3});
  } else {
    text << ", alpha_deg: " << degrees_text(joint.row.alpha_rad) << ", a_mm: " << millimetres_text(joint.row.a_m)
         << ", d_mm: " << millimetres_text(joint.row.d_m)
         << ", theta_offset_deg: " << degrees_text(joint.row.theta_rad);
    if (joint.row.beta_rad != 0.0) text << ", beta_deg: " << degrees_text(joint.row.beta_rad);
  }
  if (joint.direction < 0) text << ", direction: -1";
  if (joint.offset != 0.0) {
    text << (revolute ? ", offset_deg: " + degrees_text(joint.offset)
                      : ", offset_mm: " + millimetres_text(joint.offset));
  }
  text << limits_entry(joint.row) << gear_entry(joint.row) << "}";
  return text.str();
}

std::string origin_text(const Origin& origin) {
  return "{xyz_mm: " + yaml_mm(origin.xyz_m) + ", rpy_deg: " + rpy_text(origin.rpy_rad) + "}";
}

std::string couplings_text(const DrawnArm& arm) {
  std::vector<std::string> texts;
  for (const CommandCoupling& coupling : arm.couplings) {
    texts.push_back("{joint: " + std::to_string(coupling.joint + 1) + ", from: " + std::to_string(coupling.from + 1) +
                    ", factor: " + number_text(coupling.factor) + "}");
  }
  return yaml_list(texts);
}

std::string convention_word(const DrawnArm& arm) {
  if (arm.by_axes) return "urdf";
  return arm.convention == Convention::standard_dh ? "standard_dh" : "modified_dh";
}

}  // namespace demecal::inline data_files
