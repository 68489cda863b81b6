#include "simulation/simulated_robot.hpp"

#include "simulation/stance.hpp"
#include "simulation/statics.hpp"

namespace demecal {
namespace {

template <typename Error>
void add_deviations(JointVector& joints, const std::vector<Error>& errors, const Situation& situation) {
  for (const Error& error : errors) joints[error.joint] += deviation(error, situation);
}

template <typename Error>
void add_tilts(std::vector<Eigen::Vector3d>& tilts, const std::vector<Error>& errors, const Situation& situation) {
  for (const Error& error : errors) tilts[static_cast<std::size_t>(error.joint)] += tilt(error, situation);
}

Eigen::Vector3d normal_vector(double deviation, RandomStream& random) {
  Eigen::Vector3d vector;
  for (double& element : vector) element = deviation * random.normal();
  return vector;
}

}  // namespace

SimulatedRobot::SimulatedRobot(const Scenario& scenario) : scenario_(scenario), true_chain_(scenario.robot.chain) {
  check(scenario_);
  for (const GeometryError& error : scenario_.geometry) deform(true_chain_, error);
  true_chain_.tool_m += scenario_.tool_error_m;
}

Situation SimulatedRobot::situation(const Visit& visit) const {
  Situation situation{.commanded = visit.commanded,
                      .approach = visit.approach,
                      .loads = gravity_loads(scenario_.robot, visit.commanded, visit.payload_kg),
                      .time_s = visit.time_s};
  if (scenario_.temperature) {
    situation.warming_kelvin = temperature_celsius(*scenario_.temperature, visit.time_s) - scenario_.reference_celsius;
  }
  return situation;
}

JointVector SimulatedRobot::joints_in(const Situation& at) const {
  JointVector joints = at.commanded;
  add_deviations(joints, scenario_.joint_errors, at);
  add_deviations(joints, scenario_.gains, at);
  add_deviations(joints, scenario_.eccentricities, at);
  add_deviations(joints, scenario_.gear_harmonics, at);
  add_deviations(joints, scenario_.couplings, at);
  add_deviations(joints, scenario_.backlash, at);
  add_deviations(joints, scenario_.hysteresis, at);
  add_deviations(joints, scenario_.compliance, at);
  add_deviations(joints, scenario_.thermal_offsets, at);
  add_deviations(joints, scenario_.symbolic, at);
  return joints;
}

std::vector<Eigen::Vector3d> SimulatedRobot::axis_tilts(const Situation& at) const {
  std::vector<Eigen::Vector3d> tilts(true_chain_.joints.size(), Eigen::Vector3d::Zero());
  add_tilts(tilts, scenario_.link_bending, at);
  add_tilts(tilts, scenario_.axis_wobble, at);
  return tilts;
}

JointVector SimulatedRobot::true_joints(const Visit& visit) const {
  return joints_in(situation(visit));
}

Eigen::Isometry3d SimulatedRobot::true_pose(const Visit& visit) const {
  const Situation at = situation(visit);
  Chain chain = true_chain_;
  for (const ThermalLength& error : scenario_.thermal_lengths) deform(chain, error, at);
  Eigen::Isometry3d pose = stand(chain, joints_in(at), axis_tilts(at)).links.back();
  pose.translate(chain.tool_m);
  return drifted(scenario_.sensor_from_base * pose, scenario_.drift, visit.time_s);
}

MeasuredPose SimulatedRobot::measure(const Visit& visit, RandomStream& random) const {
  const Eigen::Isometry3d pose = true_pose(visit);
  MeasuredPose measured;
  measured.joints = visit.commanded;
  measured.position_m = scaled(pose.translation(), scenario_.sensor_scale) + normal_vector(scenario_.noise_m, random);
  if (scenario_.orientation_measured) {
    const Eigen::Vector3d noise = normal_vector(scenario_.orientation_noise_rad, random);
    measured.orientation = (rotation_by(noise) * Eigen::Quaterniond(pose.linear())).normalized();
  }
  if (scenario_.approach_recorded) measured.approach = visit.approach;
  if (!scenario_.payloads_kg.empty()) measured.payload_kg = visit.payload_kg;
  if (scenario_.temperature) measured.temperature_celsius = temperature_celsius(*scenario_.temperature, visit.time_s);
  if (scenario_.seconds_per_pose > 0.0) measured.time_s = visit.time_s;
  return measured;
}

}  // namespace demecal
