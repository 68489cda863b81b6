#include "measured_arm.hpp"

#include "data/data_set.hpp"
#include "kinematics/units.hpp"
#include "simulation/simulated_robot.hpp"

namespace demecal::bench {

constexpr std::uint64_t kDeal = 4;  ///< random stream of each scenario's seed that deals poses to sets

Robot seven_joints() {
  Robot robot;
  robot.name = "Seven joints";
  robot.chain.convention = Convention::standard_dh;
  const double alpha_deg[] = {-90, 90, 90, -90, -90, 90, 0}, d_mm[] = {360, 0, 420, 0, 400, 0, 152};
  const double limit_deg[] = {170, 120, 170, 120, 170, 120, 175};
  for (int i = 0; i < 7; ++i) {
    robot.chain.joints.push_back({.d_m = metres(d_mm[i]),
                                  .alpha_rad = radians(alpha_deg[i]),
                                  .lower = -radians(limit_deg[i]),
                                  .upper = radians(limit_deg[i])});
    robot.masses.push_back({.mass_kg = 5.0 - 0.6 * i, .centre_m = {0.0, 0.0, 0.03}});
  }
  robot.chain.tool_m = {0.045, 0.03, 0.12};
  return robot;
}

Scenario scenario_of(const Robot& robot, const Make& make, RandomStream& random) {
  Scenario scenario;
  scenario.name = robot.name;
  scenario.robot = robot;
  scenario.seed = random.index(1'000'000);
  scenario.by_joints = true;
  for (const Joint& joint : robot.chain.joints) {
    const double half = 0.5 * std::min(joint.upper - joint.lower, radians(300.0)) * make.range_share;
    const double middle = 0.5 * (joint.lower + joint.upper);
    scenario.joint_ranges.push_back({middle - half, middle + half});
  }
  scenario.poses = make.poses;
  scenario.repeats = make.repeats;
  scenario.noise_m = random.real(2e-5, 1e-4);
  scenario.orientation_measured = make.orientation;
  scenario.orientation_noise_rad = 1e-4;
  if (!make.base_frame) {
    for (double& shift : scenario.sensor_from_base.translation()) shift = random.real(-2.5, 2.5);
    scenario.sensor_from_base.linear() = (Eigen::AngleAxisd(random.real(-3.0, 3.0), Eigen::Vector3d::UnitZ()) *
                                          Eigen::AngleAxisd(random.real(-0.05, 0.05), Eigen::Vector3d::UnitX()))
                                             .toRotationMatrix();
  }
  for (double& error : scenario.tool_error_m) error = make.wrongness * 1e-3 * random.normal();
  for (int joint = 0; joint < robot.chain.size(); ++joint) {
    for (const LinkParameter parameter : {LinkParameter::theta, LinkParameter::alpha})
      scenario.geometry.push_back({joint, parameter, make.wrongness * 1.5e-3 * random.normal()});
    for (const LinkParameter parameter : {LinkParameter::a, LinkParameter::d})
      scenario.geometry.push_back({joint, parameter, make.wrongness * 5e-4 * random.normal()});
    scenario.gear_harmonics.push_back(
        {joint, static_cast<double>(2 + random.index(60)), 1e-4 * random.normal(), 1e-4 * random.normal()});
    scenario.backlash.push_back({joint, 2e-4 * random.real()});
  }
  scenario.compliance.push_back({1, 1e-6 * random.real()});
  if (make.warm) {
    scenario.seconds_per_pose = 30.0;
    scenario.temperature = TemperatureCourse{.lower_celsius = 20.0, .upper_celsius = 29.0, .period_s = 9000.0};
    scenario.thermal_lengths.push_back({1, 1.2e-5});
    scenario.drift.metres_per_s = Eigen::Vector3d(1, -1, 1) * 3e-8;
  }
  return scenario;
}

DataSet dealt(const Scenario& scenario) {
  DataSet data = simulate(scenario);
  const double total = static_cast<double>(data.poses.size());
  RandomStream random{scenario.seed, kDeal};
  split_by_pose(data.poses,
                {.validation = scenario.poses[1] * scenario.repeats / total,
                 .accept = scenario.poses[2] * scenario.repeats / total},
                [&random](std::size_t n) { return random.index(n); });
  return data;
}

DataSet with_targets(const Robot& robot, const Scenario& scenario) {
  DataSet data;
  const Eigen::Vector3d points_m[] = {{0.06, 0.0, 0.1}, {-0.05, 0.05, 0.12}, {0.0, -0.07, 0.08}};
  for (int i = 0; i < 3; ++i) {
    Scenario one = scenario;
    one.robot.chain.tool_m = points_m[i];
    DataSet measured = dealt(one);
    const std::string name(1, static_cast<char>('A' + i));
    if (i == 0) {
      data = measured;
      data.poses.clear();
      data.robot = robot;
    }
    data.tools_m[name] = points_m[i];
    for (std::size_t p = 0; p < measured.poses.size(); ++p) {
      measured.poses[p].target = name;
      const auto at = data.poses.begin() +
                      static_cast<std::ptrdiff_t>(p * static_cast<std::size_t>(i + 1) + static_cast<std::size_t>(i));
      data.poses.insert(at, measured.poses[p]);
    }
  }
  return data;
}

}  // namespace demecal::bench
