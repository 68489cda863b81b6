#include "scene.hpp"

#include <cmath>
#include <string>

#include "data/data_set.hpp"
#include "kinematics/units.hpp"
#include "random/random_stream.hpp"
#include "simulation/simulated_robot.hpp"

namespace demecal::bench {
namespace {

constexpr std::array<int, 3> kPoses{100, 60, 200};
constexpr double kNoise_m = 5e-5;
constexpr double kHalfRange_rad = radians(120.0);
constexpr double kLargestWave_rad = 1e-3;
constexpr double kLargestSlope = 4e-4;  ///< rad/rad: 0.8 mrad at the ends of the range

// What the random streams of a case are for; 1 to 4 are those of the simulation.
constexpr std::uint64_t kSmooth = 11, kPlace = 12, kSets = 13;

std::vector<std::array<double, 2>> moderate_ranges(const Chain& chain) {
  std::vector<std::array<double, 2>> ranges;
  for (const Joint& joint : chain.joints) {
    const double middle = 0.5 * (joint.lower + joint.upper);
    const double half = std::min(0.5 * (joint.upper - joint.lower), kHalfRange_rad);
    ranges.push_back({middle - half, middle + half});
  }
  return ranges;
}

std::vector<JointError> smooth_errors(int joints, RandomStream random) {
  std::vector<JointError> errors;
  for (int joint = 0; joint < joints; ++joint) {
    const double wave = random.real(-kLargestWave_rad, kLargestWave_rad), phase = random.real(0.0, 3.0);
    const double slope = random.real(-kLargestSlope, kLargestSlope);
    const std::string text =
        std::to_string(wave) + " * SIN(theta + " + std::to_string(phase) + ") + " + std::to_string(slope) + " * theta";
    errors.push_back({joint, parse(text)});
  }
  return errors;
}

Eigen::Isometry3d sensor_place(RandomStream random) {
  Eigen::Isometry3d place = Eigen::Isometry3d::Identity();
  for (double& shift : place.translation()) shift = random.real(-2.0, 2.0);
  const Eigen::Vector3d axis(random.normal(), random.normal(), random.normal());
  place.linear() = Eigen::AngleAxisd(random.real(-3.0, 3.0), axis.normalized()).toRotationMatrix();
  return place;
}

}  // namespace

Scenario varied_scene(std::uint64_t seed, const Robot& robot) {
  Scenario scenario;
  scenario.robot = robot;
  scenario.seed = seed;
  scenario.by_joints = true;
  scenario.joint_ranges = moderate_ranges(robot.chain);
  scenario.poses = kPoses;
  scenario.sensor_from_base = sensor_place(RandomStream{seed, kPlace});
  scenario.noise_m = kNoise_m;
  scenario.payloads_kg = {0.0, 3.0};
  scenario.seconds_per_pose = 20.0;
  scenario.temperature = TemperatureCourse{.lower_celsius = 18.0, .upper_celsius = 30.0, .period_s = 1700.0};
  scenario.reference_celsius = 24.0;
  scenario.joint_errors = smooth_errors(robot.chain.size(), RandomStream{seed, kSmooth});
  return scenario;
}

Scenario clean_scene(const CasePlan& plan, const Robot& robot) {
  Scenario scenario = varied_scene(plan.seed(), robot);
  scenario.name = plan.kind + ' ' + std::to_string(plan.number);
  scenario.robot_file = plan.robot_file;
  if (!row_of(plan.kind).smooth_errors) scenario.joint_errors.clear();
  return scenario;
}

DataSet measured(const Scenario& scenario) {
  DataSet data = simulate(scenario);
  const auto total = static_cast<double>(data.poses.size());
  RandomStream random{scenario.seed, kSets};
  split_by_pose(data.poses, {.validation = scenario.poses[1] / total, .accept = scenario.poses[2] / total},
                [&random](std::size_t n) { return random.index(n); });
  return data;
}

double error_of_truth_mm(const Scenario& scenario, const DataSet& data) {
  const SimulatedRobot robot(scenario);
  const std::vector<std::size_t> accept = poses_of(data, PoseSet::accept);
  double squares = 0.0;
  for (const std::size_t index : accept) {
    const MeasuredPose& pose = data.poses[index];
    const Eigen::Isometry3d true_pose = robot.true_pose({pose.joints, *pose.approach, *pose.payload_kg, *pose.time_s});
    squares += (*pose.position_m - scaled(true_pose.translation(), scenario.sensor_scale)).squaredNorm();
  }
  return 1e3 * std::sqrt(squares / static_cast<double>(accept.size()));
}

}  // namespace demecal::bench
