#include "config/scenario_file.hpp"

#include "data/contacts.hpp"
#include "data_files/robot_file.hpp"

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "data/data_set.hpp"
#include "data/text.hpp"
#include "errors/input_error.hpp"
#include "kinematics/chain.hpp"
#include "kinematics/units.hpp"
#include "simulation/truth.hpp"
#include "yaml/files.hpp"
#include "yaml/yaml_node.hpp"

namespace demecal::inline config {
namespace {

constexpr std::int64_t kMostSimulatedPoses = 1000000;
constexpr std::int64_t kMostRepeats = 1000;

int count_at(const YamlNode& node, std::string_view key) {
  const YamlNode* found = node.find(key);
  return found ? static_cast<int>(found->whole_number(0, kMostSimulatedPoses)) : 0;
}

void read_poses(const YamlNode& node, Scenario& scenario) {
  node.with_keys({"calibration", "validation", "accept", "repeats"});
  scenario.poses = {count_at(node, "calibration"), count_at(node, "validation"), count_at(node, "accept")};
  if (scenario.poses[0] + scenario.poses[1] + scenario.poses[2] == 0) node.fail("", "must be one at least");
  if (const YamlNode* repeats = node.find("repeats")) {
    scenario.repeats = static_cast<int>(repeats->whole_number(1, kMostRepeats));
  }
}

/// "q1" to "qn".
std::vector<std::string> joint_stems(const Chain& chain) {
  std::vector<std::string> stems;
  for (int i = 0; i < chain.size(); ++i) stems.push_back(std::string("q").append(std::to_string(i + 1)));
  return stems;
}

JointVector read_home(const YamlNode& node, const Chain& chain) {
  const std::vector<std::string> stems = joint_stems(chain);
  node.with_keys(keys_with_units(stems));
  JointVector home(chain.size());
  for (std::size_t i = 0; i < stems.size(); ++i) {
    const Joint& joint = chain.joints[i];
    const double value = measured_at(node, stems[i], joint.type);
    if (value < joint.lower || value > joint.upper) {
      node.fail(find_measured(node, stems[i], joint.type)->node->scalar,
                "puts joint " + std::to_string(i + 1) + " outside its limits");
    }
    home[static_cast<Eigen::Index>(i)] = value;
  }
  return home;
}

std::array<double, 2> read_joint_range(const YamlNode& node, const std::string& stem, const Joint& joint) {
  const auto measured = find_measured(node, stem, joint.type);
  if (!measured) return {joint.lower, joint.upper};
  const auto [lower, upper] = measured->node->range();
  const std::array<double, 2> range{measured->to_inside(lower), measured->to_inside(upper)};
  if (range[0] >= joint.lower && range[1] <= joint.upper) return range;
  const bool angle = is_revolute(joint);
  const auto border = [&](double value) {
    return angle ? number_text(value, degrees, radians) : number_text(value, millimetres, metres);
  };
  measured->node->fail("[" + number_text(lower) + ", " + number_text(upper) + "]",
                       "reaches beyond the joint's limits, " + border(joint.lower) + " to " + border(joint.upper) +
                           (angle ? " deg" : " mm") + "; narrow the range, or correct the limits in the robot file");
}

void read_joint_ranges(const YamlNode& node, Scenario& scenario) {
  const std::vector<std::string> stems = joint_stems(scenario.robot.chain);
  node.with_keys(keys_with_units(stems));
  scenario.by_joints = true;
  for (std::size_t i = 0; i < stems.size(); ++i) {
    scenario.joint_ranges.push_back(read_joint_range(node, stems[i], scenario.robot.chain.joints[i]));
  }
}

void read_cuboid(const YamlNode& node, Scenario& scenario) {
  node.with_keys({"corner_mm", "size_mm", "orientation_spread_deg"});
  scenario.box_corner_m = metres(1.0) * node.at("corner_mm").vector3();
  scenario.box_size_m = metres(1.0) * node.at("size_mm").vector3();
  if ((scenario.box_size_m.array() < 0.0).any()) node.at("size_mm").fail("", "must not be negative");
  if (const YamlNode* spread = node.find("orientation_spread_deg")) {
    scenario.orientation_spread_rad = radians(spread->number(0.0, 180.0));
  }
}

/// Where the robot is sent: one of the two ways to say it.
void read_region(const YamlNode& root, Scenario& scenario) {
  const YamlNode* cuboid = root.find("cuboid");
  const YamlNode* ranges = root.find("joint_ranges");
  if (!cuboid && !ranges) root.fail("", "cuboid or joint_ranges is missing: where to send the robot");
  if (cuboid && ranges) ranges->fail("", "contradicts cuboid: give one of them");
  if (const YamlNode* home = root.find("home")) scenario.home = read_home(*home, scenario.robot.chain);
  if (cuboid && !scenario.home.size() && scenario.robot.chain.size() >= 6) {
    root.fail("", "home is missing: the joints whose orientation the poses vary around");
  }
  if (ranges) read_joint_ranges(*ranges, scenario);
  if (cuboid) read_cuboid(*cuboid, scenario);
}

Eigen::Isometry3d read_transform(const YamlNode& node) {
  node.with_keys({"translation_mm", "rotation_deg"});
  Eigen::Isometry3d transform = Eigen::Isometry3d::Identity();
  if (const YamlNode* translation = node.find("translation_mm")) {
    transform.translation() = metres(1.0) * translation->vector3();
  }
  if (const YamlNode* rotation = node.find("rotation_deg")) {
    const Eigen::Vector3d vector_rad = radians(1.0) * rotation->vector3();
    const double angle_rad = vector_rad.norm();
    if (angle_rad > 0.0) transform.linear() = Eigen::AngleAxisd(angle_rad, vector_rad / angle_rad).toRotationMatrix();
  }
  return transform;
}

void read_temperature_course(const YamlNode& node, Scenario& scenario) {
  node.with_keys({"lower_celsius", "upper_celsius", "period_s", "reference_celsius"});
  scenario.temperature = TemperatureCourse{.lower_celsius = node.at("lower_celsius").number(),
                                           .upper_celsius = node.at("upper_celsius").number(),
                                           .period_s = node.at("period_s").positive()};
  if (const YamlNode* reference = node.find("reference_celsius")) scenario.reference_celsius = reference->number();
}

void read_measurement(const YamlNode& node, Scenario& scenario) {
  node.with_keys({"sensor_from_base", "noise_mm", "orientation_noise_deg", "approach_recorded", "torque_log",
                  "payloads_kg", "interval_s", "temperature"});
  if (const YamlNode* frame = node.find("sensor_from_base")) scenario.sensor_from_base = read_transform(*frame);
  if (const YamlNode* noise = node.find("noise_mm")) scenario.noise_m = metres(noise->non_negative());
  if (const YamlNode* noise = node.find("orientation_noise_deg")) {
    scenario.orientation_measured = true;
    scenario.orientation_noise_rad = radians(noise->non_negative());
  }
  if (const YamlNode* recorded = node.find("approach_recorded")) scenario.approach_recorded = recorded->boolean();
  if (const YamlNode* log = node.find("torque_log")) {
    log->with_keys({"noise_nm", "friction_nm"});
    scenario.torque_log.emplace();
    if (const YamlNode* noise = log->find("noise_nm")) scenario.torque_log->noise = noise->non_negative();
    if (const YamlNode* friction = log->find("friction_nm")) scenario.torque_log->friction = friction->non_negative();
  }
  if (const YamlNode* payloads = node.find("payloads_kg")) {
    for (const YamlNode& payload : payloads->list()) scenario.payloads_kg.push_back(payload.non_negative());
  }
  if (const YamlNode* interval = node.find("interval_s")) scenario.seconds_per_pose = interval->non_negative();
  if (const YamlNode* temperature = node.find("temperature")) read_temperature_course(*temperature, scenario);
}

void read_touched(const YamlNode& node, Scenario& scenario) {
  node.with_keys({"points_mm", "accept", "play_mm", "distances"});
  const YamlNode& points = node.at("points_mm");
  if (points.kind != YamlNode::Kind::map) points.fail("must be a map of contacts and their points");
  for (const YamlNode& point : points.children)
    scenario.touched.push_back({point.name, metres(1.0) * point.vector3(), false});
  if (scenario.touched.empty()) points.fail("must name one contact at least");
  const auto named = [&](const YamlNode& name) -> TouchedPoint& {
    for (TouchedPoint& point : scenario.touched)
      if (point.contact == name.text()) return point;
    name.fail("is no contact of points_mm");
  };
  if (const YamlNode* accept = node.find("accept"))
    for (const YamlNode& name : accept->list()) named(name).for_acceptance = true;
  if (const YamlNode* play = node.find("play_mm")) scenario.play_m = metres(play->non_negative());
  if (const YamlNode* distances = node.find("distances")) {
    for (const YamlNode& one : distances->list()) {
      one.with_keys({"between", "mm", "sigma_mm"});
      const std::vector<YamlNode>& ends = one.at("between").list(2);
      scenario.known_distances.push_back({named(ends[0]).contact, named(ends[1]).contact,
                                          metres(one.at("mm").positive()), metres(one.at("sigma_mm").positive())});
    }
  }
}

/// A simulated robot's weight does no more than that of a robot file with a positioner: nothing.
void refuse_weight(const YamlNode& root, const Scenario& scenario) {
  constexpr const char* kTurns =
      "carries weight, which turns with the workpiece that a positioner carries: leave it out";
  if (scenario.robot.chain.positioner == 0) return;
  if (scenario.torque_log) root.at("measurement").at("torque_log").fail("", kTurns);
  visit_joint_errors(scenario, [&](const char* key, const auto& errors) {
    for (const auto& error : errors)
      if constexpr (requires { error.takes_weight(); })
        if (error.takes_weight()) root.at("errors").at(key).fail("", kTurns);
  });
}

/// The simulation's own rules know no file.
void check_scenario(const Scenario& scenario, const YamlNode& root) {
  try {
    check(scenario);
  } catch (const InputError& fault) {
    throw InputError({root.file, 0}, fault.value(), fault.rule());
  }
}

}  // namespace

Scenario load_scenario(const std::filesystem::path& path) {
  const YamlNode root = read_yaml(path);
  root.with_version("scenario", 1)
      .with_keys({"demecal_scenario", "name", "robot", "seed", "poses", "cuboid", "joint_ranges", "home", "measurement",
                  "contacts", "errors"});
  Scenario scenario;
  scenario.name = root.find("name") ? root.at("name").text() : path.stem().string();
  scenario.robot = read_named(root.at("robot"), load_robot);
  scenario.robot_file = resolve(path, root.at("robot").text()).string();
  if (const YamlNode* seed = root.find("seed")) scenario.seed = seed->seed();
  read_poses(root.at("poses"), scenario);
  read_region(root, scenario);
  if (const YamlNode* measurement = root.find("measurement")) read_measurement(*measurement, scenario);
  if (const YamlNode* contacts = root.find("contacts")) read_touched(*contacts, scenario);
  if (const YamlNode* errors = root.find("errors")) read_true_errors(*errors, scenario);
  refuse_weight(root, scenario);
  check_scenario(scenario, root);
  return scenario;
}

}  // namespace demecal::inline config
