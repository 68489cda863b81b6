#include "config/input_files.hpp"

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <numbers>
#include <optional>
#include <sstream>
#include <utility>
#include <vector>

#include "data/text.hpp"
#include "errors/input_error.hpp"
#include "kinematics/chain.hpp"
#include "kinematics/units.hpp"
#include "symbolic/parse_expression.hpp"
#include "yaml/yaml_node.hpp"
#include "yaml/yaml_text.hpp"

namespace demecal::inline config {
namespace {

constexpr double kMostGravity_mps2 = 20.0;  // beyond it stands a mistaken unit, not another planet
constexpr double kShortestReach_m = 0.01;   // below it lengths were given in metres

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

Joint read_joint(const YamlNode& node) {
  node.with_keys({"type", "alpha_deg", "a_mm", "d_mm", "theta_offset_deg", "beta_deg", "limits_deg", "limits_mm"});
  Joint joint;
  joint.type =
      node.at("type").one_of<JointType>({{"revolute", JointType::revolute}, {"prismatic", JointType::prismatic}});
  joint.alpha_rad = link_angle(node.at("alpha_deg"));
  joint.a_m = metres(node.at("a_mm").number());
  joint.d_m = metres(node.at("d_mm").number());
  joint.theta_rad = optional_angle(node.find("theta_offset_deg"));
  joint.beta_rad = optional_angle(node.find("beta_deg"));
  const bool revolute = is_revolute(joint);
  if (const YamlNode* wrong = node.find(revolute ? "limits_mm" : "limits_deg")) {
    wrong->fail("", std::string("is of the wrong unit: ") +
                        (revolute ? "a revolute joint has limits_deg" : "a prismatic joint has limits_mm"));
  }
  const auto [lower, upper] = node.at(revolute ? "limits_deg" : "limits_mm").range();
  joint.lower = revolute ? radians(lower) : metres(lower);
  joint.upper = revolute ? radians(upper) : metres(upper);
  return joint;
}

void check_reach(const YamlNode& joints, const Chain& chain) {
  double reach_m = 0.0;
  for (const Joint& joint : chain.joints) {
    reach_m += std::abs(joint.a_m) + std::abs(joint.d_m);
    if (!is_revolute(joint)) reach_m += std::max(std::abs(joint.lower), std::abs(joint.upper));
  }
  if (reach_m > 0.0 && reach_m < kShortestReach_m) {
    joints.fail("", "reach less than " + number_text(millimetres(kShortestReach_m)) +
                        " mm in all; lengths are expected in millimetres and look like metres");
  }
}

Chain read_chain(const YamlNode& node) {
  Chain chain;
  chain.convention =
      node.at("convention")
          .one_of<Convention>({{"standard_dh", Convention::standard_dh}, {"modified_dh", Convention::modified_dh}});
  const YamlNode& joints = node.at("joints");
  if (joints.list().empty() || joints.children.size() > static_cast<std::size_t>(kMaxJoints)) {
    joints.fail("",
                "must be from 1 to " + std::to_string(kMaxJoints) + ", not " + std::to_string(joints.children.size()));
  }
  for (const YamlNode& joint : joints.children) chain.joints.push_back(read_joint(joint));
  check_reach(joints, chain);
  chain.tool_m = metres(1.0) * node.at("tool_mm").vector3();
  return chain;
}

std::vector<LinkMass> read_masses(const YamlNode& links, std::size_t joints) {
  std::vector<LinkMass> masses;
  for (const YamlNode& link : links.list(joints)) {
    link.with_keys({"mass_kg", "com_mm"});
    masses.push_back({link.at("mass_kg").non_negative(), metres(1.0) * link.at("com_mm").vector3()});
  }
  return masses;
}

Eigen::Vector3d read_gravity(const YamlNode& node) {
  const Eigen::Vector3d gravity_mps2 = node.vector3();
  if (gravity_mps2.norm() > kMostGravity_mps2) {
    node.fail("", "must not exceed " + number_text(kMostGravity_mps2) + " m/s^2 in size");
  }
  return gravity_mps2;
}

JointVector read_declared_home(const YamlNode& node, const Chain& chain) {
  const std::vector<double> values = node.numbers();
  if (std::ssize(values) != chain.size())
    node.fail(std::to_string(values.size()) + " numbers", "the robot has " + std::to_string(chain.size()) + " joints");
  return joints_from_deg_or_mm(chain, values);
}

std::string joint_text(const Joint& joint) {
  const bool revolute = is_revolute(joint);
  const auto limit = revolute ? degrees_text : millimetres_text;
  std::ostringstream text;
  text << "{type: " << (revolute ? "revolute" : "prismatic") << ", alpha_deg: " << degrees_text(joint.alpha_rad)
       << ", a_mm: " << millimetres_text(joint.a_m) << ", d_mm: " << millimetres_text(joint.d_m)
       << ", theta_offset_deg: " << degrees_text(joint.theta_rad);
  if (joint.beta_rad != 0.0) text << ", beta_deg: " << degrees_text(joint.beta_rad);
  text << (revolute ? ", limits_deg: [" : ", limits_mm: [") << limit(joint.lower) << ", " << limit(joint.upper) << "]}";
  return text.str();
}

std::string home_text(const Robot& robot) {
  std::string values;
  for (Eigen::Index i = 0; i < robot.home.size(); ++i) {
    const bool revolute = is_revolute(robot.chain, i);
    values += (i == 0 ? "" : ", ") + (revolute ? degrees_text(robot.home[i]) : millimetres_text(robot.home[i]));
  }
  return "[" + values + "]";
}

SymbolNames read_names(Algebra& algebra, const YamlNode& file, std::vector<Expression>& joints) {
  SymbolNames names;
  const YamlNode& list = file.at("joints");
  for (const YamlNode& name : list.list()) {
    joints.push_back(algebra.symbol(commanded_joint(static_cast<int>(joints.size()) + 1)));
    if (!names.emplace(name.text(), joints.back()).second) name.fail("is named twice");
  }
  if (joints.empty() || joints.size() > static_cast<std::size_t>(kMaxJoints)) {
    list.fail("", "must name 1 to " + std::to_string(kMaxJoints) + " joints");
  }
  if (const YamlNode* values = file.find("values")) {
    if (values->kind != YamlNode::Kind::map) values->fail("must be a map of names and numbers");
    for (const YamlNode& value : values->children) {
      if (!names.emplace(value.name, algebra.constant(value.number())).second) value.fail("is a joint as well");
    }
  }
  return names;
}

MatrixText read_matrix(const YamlNode& node) {
  MatrixText text;
  const std::vector<YamlNode>& rows = node.list(3);
  for (std::size_t row = 0; row < 3; ++row) {
    const std::vector<YamlNode>& elements = rows[row].list(4);
    for (std::size_t column = 0; column < 4; ++column) text[row][column] = elements[column].text();
  }
  return text;
}

}  // namespace

Robot read_robot(const YamlNode& node) {
  node.with_keys({"demecal_robot", "name", "convention", "joints", "tool_mm", "links", "gravity_mps2",
                  "repeatability_mm", "home_deg"});
  Robot robot;
  robot.name = node.at("name").text();
  robot.chain = read_chain(node);
  if (const YamlNode* links = node.find("links")) robot.masses = read_masses(*links, robot.chain.joints.size());
  if (const YamlNode* gravity = node.find("gravity_mps2")) robot.gravity_mps2 = read_gravity(*gravity);
  if (const YamlNode* spread = node.find("repeatability_mm")) robot.repeatability_m = metres(spread->non_negative());
  if (const YamlNode* home = node.find("home_deg")) robot.home = read_declared_home(*home, robot.chain);
  return robot;
}

Robot load_robot(const std::filesystem::path& path) {
  return read_robot(read_yaml(path).with_version("robot", 1));
}

std::string robot_text(const Robot& robot, int indent) {
  const std::string margin(static_cast<std::size_t>(indent), ' ');
  const char* convention = robot.chain.convention == Convention::standard_dh ? "standard_dh" : "modified_dh";
  std::ostringstream text;
  text << margin << "name: " << yaml_text(robot.name) << '\n';
  text << margin << "convention: " << convention << '\n';
  text << margin << "joints:\n";
  for (const Joint& joint : robot.chain.joints) text << margin << "  - " << joint_text(joint) << '\n';
  text << margin << "tool_mm: " << yaml_mm(robot.chain.tool_m) << '\n';
  if (!robot.masses.empty()) text << margin << "links:\n";
  for (const LinkMass& link : robot.masses) {
    text << margin << "  - {mass_kg: " << number_text(link.mass_kg) << ", com_mm: " << yaml_mm(link.centre_m) << "}\n";
  }
  text << margin << "gravity_mps2: " << yaml_numbers({robot.gravity_mps2.data(), 3}) << '\n';
  if (robot.repeatability_m) text << margin << "repeatability_mm: " << millimetres_text(*robot.repeatability_m) << '\n';
  if (robot.home.size() > 0) text << margin << "home_deg: " << home_text(robot) << '\n';
  return text.str();
}

Listing load_matrices(Algebra& algebra, const std::filesystem::path& path) {
  const YamlNode file = read_yaml(path).with_version("matrices", 1);
  file.with_keys({"demecal_matrices", "name", "joints", "values", "matrices"});
  Listing listing{{file.at("name").text()}, {}, {}};
  const SymbolNames names = read_names(algebra, file, listing.actual);
  std::string joints;
  for (const YamlNode& name : file.at("joints").list()) joints += (joints.empty() ? "" : ", ") + name.text();
  listing.remarks.push_back(
      "q1 .. qn are " + joints +
      " of the matrices, in rad or the unit of their lengths; the pose is their product, row by row.");
  listing.pose = parse_product(algebra, {});
  for (const YamlNode& node : file.at("matrices").list()) {
    try {
      listing.pose = product(listing.pose, parse_matrix(algebra, read_matrix(node), names));
    } catch (const InputError& error) {
      if (!error.where().file.empty()) throw;
      node.fail(error.value(), error.rule());
    }
  }
  return listing;
}

}  // namespace demecal::inline config
