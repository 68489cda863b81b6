#include "simulation/simulated_robot.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <map>
#include <optional>
#include <string>

#include "data/contacts.hpp"
#include "random/random_purpose.hpp"
#include "simulation/stance.hpp"
#include "simulation/touching.hpp"
#include "simulation/truth.hpp"

namespace demecal::inline simulation {
namespace {

Eigen::Vector3d normal_vector(double deviation, RandomStream& random) {
  Eigen::Vector3d vector;
  for (double& element : vector) element = deviation * random.normal();
  return vector;
}

PoseSet set_of(std::size_t pose, const std::array<int, 3>& counts) {
  const auto number = static_cast<int>(pose);
  if (number < counts[0]) return PoseSet::calibration;
  return number < counts[0] + counts[1] ? PoseSet::validation : PoseSet::accept;
}

/// Any pose but `pose`; the only one where there is no other.
std::size_t another(std::size_t pose, std::size_t poses, RandomStream& random) {
  return poses < 2 ? pose : (pose + 1 + random.index(poses - 1)) % poses;
}

double draw_payload(const std::vector<double>& payloads_kg, RandomStream& random) {
  return payloads_kg.empty() ? 0.0 : payloads_kg[random.index(payloads_kg.size())];
}

class Tour {
 public:
  explicit Tour(const Scenario& scenario)
      : scenario_(scenario),
        noise_{scenario.seed, number_of(SimulationPurpose::noise)},
        payload_{scenario.seed, number_of(SimulationPurpose::payload)},
        repeats_{scenario.seed, number_of(SimulationPurpose::repeats)} {
    RandomStream random{scenario.seed, number_of(SimulationPurpose::poses)};
    poses_ = draw_poses(scenario, scenario.poses[0] + scenario.poses[1] + scenario.poses[2], random);
  }

  std::vector<MeasuredPose> measure(const SimulatedRobot& robot) {
    std::vector<MeasuredPose> rows;
    for (std::size_t pose = 0; pose < poses_.size(); ++pose) {
      const double payload_kg = draw_payload(scenario_.payloads_kg, payload_);
      for (int repeat = 0; repeat < scenario_.repeats; ++repeat) {
        Visit visit{.commanded = poses_[pose],
                    .approach = signs_of_move(come_from(pose, repeat), poses_[pose]),
                    .payload_kg = payload_kg,
                    .time_s = scenario_.seconds_per_pose * static_cast<double>(rows.size())};
        const PoseSet set = set_of(pose, scenario_.poses);
        rows.push_back(scenario_.touched.empty() ? robot.measure(visit, noise_) : touch(robot, pose, set, visit));
        rows.back().set = set;
        rows.back().pose_id = std::to_string(pose + 1).insert(0, 1, 'P');
      }
    }
    return rows;
  }

 private:
  /// The pose moved so that the tool touches its contact. The next one comes from there.
  MeasuredPose touch(const SimulatedRobot& robot, std::size_t pose, PoseSet set, const Visit& start) {
    const TouchedPoint& point = touched_by(scenario_, set, touches_[set]++);
    const JointVector from = pose > 0 ? poses_[pose - 1] : scenario_.home.size() > 0 ? scenario_.home : poses_[0];
    const Visit visit = touching_visit(scenario_, robot, point, start, from, noise_);
    poses_[pose] = visit.commanded;
    MeasuredPose touched = robot.measure(visit, noise_);
    touched.position_m.reset();
    touched.contact = point.contact;
    return touched;
  }

  const JointVector& come_from(std::size_t pose, int repeat) {
    if (repeat > 0) return poses_[another(pose, poses_.size(), repeats_)];
    if (pose > 0) return poses_[pose - 1];
    return scenario_.home.size() > 0 ? scenario_.home : poses_[0];
  }

  const Scenario& scenario_;
  RandomStream noise_, payload_, repeats_;  ///< apart, so that another noise leaves the poses as they are
  std::vector<JointVector> poses_;
  std::map<PoseSet, std::size_t> touches_;
};

}  // namespace

SimulatedRobot::SimulatedRobot(const Scenario& scenario) : scenario_(scenario), true_chain_(scenario.robot.chain) {
  check(scenario_);
  visit_joint_errors(scenario_, [this](const char* /*key*/, const auto& errors) {
    if constexpr (requires { deform(true_chain_, errors.front()); }) {
      for (const auto& error : errors) deform(true_chain_, error);
    }
  });
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

JointVector SimulatedRobot::joints_in(const Situation& circumstances) const {
  JointVector joints = driven_joints(true_chain_, circumstances.commanded);
  visit_joint_errors(scenario_, [&](const char* /*key*/, const auto& errors) {
    if constexpr (requires { deviation(errors.front(), circumstances); }) {
      for (const auto& error : errors) joints[error.joint] += deviation(error, circumstances);
    }
  });
  return commanded_joints(true_chain_, joints);
}

std::vector<Eigen::Vector3d> SimulatedRobot::axis_tilts(const Situation& circumstances) const {
  std::vector<Eigen::Vector3d> tilts(true_chain_.joints.size(), Eigen::Vector3d::Zero());
  visit_joint_errors(scenario_, [&](const char* /*key*/, const auto& errors) {
    if constexpr (requires { tilt(errors.front(), circumstances); }) {
      for (const auto& error : errors) tilts[static_cast<std::size_t>(error.joint)] += tilt(error, circumstances);
    }
  });
  return tilts;
}

JointVector SimulatedRobot::true_joints(const Visit& visit) const {
  return joints_in(situation(visit));
}

Eigen::Isometry3d SimulatedRobot::true_pose(const Visit& visit) const {
  const Situation circumstances = situation(visit);
  Chain chain = true_chain_;
  visit_joint_errors(scenario_, [&](const char* /*key*/, const auto& errors) {
    if constexpr (requires { deform(chain, errors.front(), circumstances); }) {
      for (const auto& error : errors) deform(chain, error, circumstances);
    }
  });
  Eigen::Isometry3d pose = stand(chain, joints_in(circumstances), axis_tilts(circumstances)).flange;
  pose.translate(chain.tool_m);
  return drifted(scenario_.sensor_from_base * pose, scenario_.drift, visit.time_s);
}

JointVector SimulatedRobot::logged_torque(const Visit& visit, RandomStream& random) const {
  const Situation now = situation(visit);
  JointVector torque(visit.commanded.size());
  for (Eigen::Index joint = 0; joint < torque.size(); ++joint) {
    torque[joint] = scenario_.torque_log->friction * visit.approach[joint] -
                    now.loads[static_cast<std::size_t>(joint)].effort + scenario_.torque_log->noise * random.normal();
  }
  return torque;
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
  if (scenario_.torque_log) measured.torque = logged_torque(visit, random);
  if (!scenario_.payloads_kg.empty()) measured.payload_kg = visit.payload_kg;
  if (scenario_.temperature) measured.temperature_celsius = temperature_celsius(*scenario_.temperature, visit.time_s);
  if (scenario_.seconds_per_pose > 0.0) measured.time_s = visit.time_s;
  return measured;
}

DataSet simulate(const Scenario& scenario) {
  const SimulatedRobot robot(scenario);
  DataSet data;
  data.name = scenario.name;
  data.robot = scenario.robot;
  data.frame = scenario.sensor_from_base.matrix().isIdentity(0.0) ? Frame::base : Frame::sensor;
  data.poses = Tour(scenario).measure(robot);
  for (const KnownDistance& known : scenario.known_distances) {
    const auto touched = [&](const std::string& contact) {
      return std::ranges::any_of(data.poses, [&](const MeasuredPose& pose) { return pose.contact == contact; });
    };
    if (touched(known.first) && touched(known.second)) data.contacts.distances.push_back(known);
  }
  return data;
}

}  // namespace demecal::inline simulation
