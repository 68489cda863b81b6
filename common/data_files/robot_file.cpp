#include "data_files/robot_file.hpp"

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <optional>
#include <sstream>
#include <utility>
#include <vector>

#include "data/link_inertia.hpp"
#include "data/payload.hpp"
#include "data/text.hpp"
#include "data_files/link_inertias.hpp"
#include "errors/input_error.hpp"
#include "kinematics/chain.hpp"
#include "kinematics/drawn_arm.hpp"
#include "kinematics/units.hpp"
#include "symbolic/parse_expression.hpp"
#include "yaml/files.hpp"
#include "yaml/yaml_node.hpp"
#include "yaml/yaml_text.hpp"

namespace demecal::inline data_files {
namespace {

constexpr double kMostGravity_mps2 = 20.0;  // beyond it stands a mistaken unit, not another planet

std::vector<LinkMass> read_masses(const YamlNode& links, std::size_t joints) {
  std::vector<LinkMass> masses;
  for (const YamlNode& link : links.list(joints)) {
    link.with_keys({"mass_kg", "com_mm", "inertia_kgm2"});
    masses.push_back({link.at("mass_kg").non_negative(), metres(1.0) * link.at("com_mm").vector3()});
    read_link_inertia(link);  // refused where no body has it
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

/// Gravity is told in the frame that the chain begins in, which turns with a positioner; nor does the arm rest on the
/// positioner's joints.
void leave_weight_out(const YamlNode& node, Robot& robot) {
  const YamlNode* const gravity = node.find("gravity_mps2");
  if (gravity != nullptr && !robot.gravity_mps2.isZero(0.0))
    gravity->fail("", "turns with the workpiece that a positioner carries: leave it out, or write [0, 0, 0]");
  if (const YamlNode* links = node.find("links"))
    links->fail("", "have weights, which turn with the workpiece that a positioner carries: leave them out");
  if (const YamlNode* balancers = node.find("balancers"))
    balancers->fail("", "carry weight, which turns with the workpiece that a positioner carries: leave them out");
  robot.gravity_mps2.setZero();
}

double read_most_payload(const YamlNode& node) {
  const double payload_kg = node.positive();
  if (payload_kg > kMostPayload_kg)
    node.fail("", "must not exceed " + number_text(kMostPayload_kg) + ", more than any robot carries: it is in kg");
  return payload_kg;
}

/// The file's place is kept whole: models that hold the robot stand in other folders.
UrdfSource read_urdf_source(const YamlNode& node) {
  node.with_keys({"file", "base", "tip"});
  const std::filesystem::path file = resolve(node.file, node.at("file").text());
  return {std::filesystem::absolute(file).lexically_normal().string(), node.at("base").text(), node.at("tip").text()};
}

JointVector read_declared_home(const YamlNode& node, const Chain& chain) {
  const std::vector<double> values = node.numbers();
  if (std::ssize(values) != chain.size())
    node.fail(std::to_string(values.size()) + " numbers",
              "must be " + std::to_string(chain.size()) + ", one for each of the robot's joints");
  return joints_from_deg_or_mm(chain, values);
}

std::vector<double> read_pulses(const YamlNode& node, const Chain& chain) {
  const std::vector<double> values = node.numbers();
  if (std::ssize(values) != chain.size())
    node.fail(std::to_string(values.size()) + " numbers",
              "must be " + std::to_string(chain.size()) + ", one for each of the robot's joints");
  for (const double value : values) {
    if (value == 0.0) node.fail("0", "must not be zero: it is how many pulses a degree has");
  }
  return values;
}

std::vector<Balancer> read_balancers(const YamlNode& list, const Chain& chain) {
  constexpr double kLeastDifference_m = 1e-3;
  std::vector<Balancer> balancers;
  for (const YamlNode& node : list.list()) {
    node.with_keys({"joint", "fixed_mm", "moving_mm", "shortest_deg"});
    const int joint = static_cast<int>(node.at("joint").whole_number(1, chain.size())) - 1;
    if (!is_revolute(chain, joint)) node.at("joint").fail("joint slides: a balancer relieves one that turns");
    const auto same = [&](const Balancer& one) { return one.joint == joint; };
    if (std::ranges::any_of(balancers, same)) node.at("joint").fail("has a balancer already");
    balancers.push_back({joint, metres(node.at("fixed_mm").positive()), metres(node.at("moving_mm").positive()),
                         radians(node.at("shortest_deg").number())});
    if (std::abs(balancers.back().fixed_m - balancers.back().moving_m) < kLeastDifference_m)
      node.at("moving_mm").fail("must differ from fixed_mm by 1 mm or more: the spring's length would come to nothing");
  }
  return balancers;
}

/// The arm of a robot that was read as rows, or made without a file.
DrawnArm drawing_of(const Robot& robot) {
  if (robot.drawing) return *robot.drawing;
  DrawnArm arm{.convention = robot.chain.convention, .joints = {}};
  for (const Joint& joint : robot.chain.joints) arm.joints.push_back({.row = joint});
  for (const LinkMass& link : robot.masses) arm.centres_m.push_back(link.centre_m);
  return arm;
}

/// The masses' centres in the frames of the chain's links.
void set_centres(Robot& robot, const std::vector<Eigen::Isometry3d>& drawn_links) {
  for (std::size_t i = 0; i < robot.masses.size(); ++i)
    robot.masses[i].centre_m = drawn_links[i] * robot.masses[i].centre_m;
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
  node.with_keys({"demecal_robot", "name", "convention", "base", "joints", "positioner", "workpiece", "flange",
                  "couplings", "tool_mm", "links", "gravity_mps2", "urdf", "repeatability_mm", "payload_kg", "home_deg",
                  "pulses_per_deg", "balancers"});
  Robot robot;
  robot.name = node.at("name").text();
  DrawnArm drawing = read_drawing(node);
  EquivalentChain equivalent = equivalent_chain(drawing);
  robot.chain = std::move(equivalent.chain);
  robot.chain.tool_m = metres(1.0) * node.at("tool_mm").vector3();
  constexpr double kMostTool_m = 100.0;
  if (robot.chain.tool_m.cwiseAbs().maxCoeff() > kMostTool_m)
    node.at("tool_mm").fail("must lie within 100 m of the flange: it is in mm");
  if (const YamlNode* links = node.find("links")) robot.masses = read_masses(*links, robot.chain.joints.size());
  if (is_more_than_rows(drawing)) {
    for (const LinkMass& link : robot.masses) drawing.centres_m.push_back(link.centre_m);
    robot.drawing = std::move(drawing);
    set_centres(robot, equivalent.drawn_links);
  }
  if (const YamlNode* gravity = node.find("gravity_mps2")) robot.gravity_mps2 = read_gravity(*gravity);
  if (node.find("positioner") != nullptr) leave_weight_out(node, robot);
  if (const YamlNode* spread = node.find("repeatability_mm")) robot.repeatability_m = metres(spread->non_negative());
  if (const YamlNode* payload = node.find("payload_kg")) robot.payload_kg = read_most_payload(*payload);
  if (const YamlNode* urdf = node.find("urdf")) robot.urdf = read_urdf_source(*urdf);
  if (const YamlNode* home = node.find("home_deg")) robot.home = read_declared_home(*home, robot.chain);
  if (const YamlNode* pulses = node.find("pulses_per_deg")) robot.pulses_per_deg = read_pulses(*pulses, robot.chain);
  if (const YamlNode* list = node.find("balancers")) robot.balancers = read_balancers(*list, robot.chain);
  return robot;
}

Robot load_robot(const std::filesystem::path& path) {
  return read_robot(read_yaml(path).with_version("robot", 1));
}

std::string robot_text(const Robot& robot, int indent) {
  return robot_text(robot, LinkInertias{}, indent);
}

std::string robot_text(const Robot& robot, const LinkInertias& inertias, int indent) {
  const std::string margin(static_cast<std::size_t>(indent), ' ');
  const DrawnArm drawing = drawing_of(robot);
  std::ostringstream text;
  text << margin << "name: " << yaml_text(robot.name) << '\n';
  text << margin << "convention: " << convention_word(drawing) << '\n';
  const DrawnPositioner positioner = drawing.positioner.value_or(DrawnPositioner{});
  const Origin& base = drawing.positioner ? positioner.base : drawing.base;
  if (base != Origin{}) text << margin << "base: " << origin_text(base) << '\n';
  std::vector<DrawnJoint> joints(drawing.joints.begin() + std::ssize(positioner.joints), drawing.joints.end());
  if (drawing.positioner) joints.front().origin = positioner.first_joint;
  text << margin << "joints:\n";
  for (const DrawnJoint& joint : joints) text << margin << "  - " << joint_text(drawing, joint) << '\n';
  if (drawing.positioner) text << margin << "positioner:\n";
  for (const DrawnJoint& axis : positioner.joints) text << margin << "  - " << joint_text(drawing, axis) << '\n';
  if (positioner.workpiece != Origin{}) text << margin << "workpiece: " << origin_text(positioner.workpiece) << '\n';
  if (drawing.flange != Origin{}) text << margin << "flange: " << origin_text(drawing.flange) << '\n';
  if (!drawing.couplings.empty()) text << margin << "couplings: " << couplings_text(drawing) << '\n';
  text << margin << "tool_mm: " << yaml_mm(robot.chain.tool_m) << '\n';
  if (!robot.masses.empty()) text << margin << "links:\n";
  for (std::size_t i = 0; i < robot.masses.size(); ++i) {
    text << margin << "  - {mass_kg: " << number_text(robot.masses[i].mass_kg)
         << ", com_mm: " << yaml_mm(drawing.centres_m.at(i));
    if (i < inertias.size() && inertias[i]) text << ", inertia_kgm2: " << yaml_numbers(matrix_elements(*inertias[i]));
    text << "}\n";
  }
  text << margin << "gravity_mps2: " << yaml_numbers({robot.gravity_mps2.data(), 3}) << '\n';
  if (robot.repeatability_m) text << margin << "repeatability_mm: " << millimetres_text(*robot.repeatability_m) << '\n';
  if (robot.payload_kg) text << margin << "payload_kg: " << number_text(*robot.payload_kg) << '\n';
  if (robot.urdf) {
    text << margin << "urdf: {file: " << yaml_text(robot.urdf->file) << ", base: " << yaml_text(robot.urdf->base)
         << ", tip: " << yaml_text(robot.urdf->tip) << "}\n";
  }
  if (robot.home.size() > 0) text << margin << "home_deg: " << home_text(robot) << '\n';
  if (!robot.pulses_per_deg.empty()) text << margin << "pulses_per_deg: " << yaml_numbers(robot.pulses_per_deg) << '\n';
  if (!robot.balancers.empty()) text << margin << "balancers:\n";
  for (const Balancer& one : robot.balancers) {
    text << margin << "  - {joint: " << one.joint + 1 << ", fixed_mm: " << millimetres_text(one.fixed_m)
         << ", moving_mm: " << millimetres_text(one.moving_m) << ", shortest_deg: " << degrees_text(one.shortest_rad)
         << "}\n";
  }
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

}  // namespace demecal::inline data_files
