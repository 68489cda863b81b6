// Arms whose errors we know, and what an instrument would measure of them.
#pragma once

#include <numbers>
#include <string>
#include <vector>

#include "fitting/fit.hpp"
#include "kinematics/angles.hpp"
#include "kinematics/random_arm.hpp"

namespace demecal {

/// An arm as its maker describes it, without poses yet, and as it really is.
struct KnownArm {
  DataSet data;
  CorrectedRobot truth;
};

struct Instrument {
  double noise_m = 0.0;  ///< standard deviation per axis, and of distances
  double noise_rad = 0.0;
  bool position = true;
  bool orientation = false;
};

inline Joint link(JointType type, double alpha_rad, double a_m, double d_m) {
  Joint joint;
  joint.type = type;
  joint.alpha_rad = alpha_rad;
  joint.a_m = a_m;
  joint.d_m = d_m;
  joint.upper = type == JointType::revolute ? 2.5 : 0.4;
  joint.lower = type == JointType::revolute ? -2.5 : 0.0;
  return joint;
}

inline constexpr DeclaredModel kPlaced{.registration = true, .tool = true};
inline constexpr DeclaredModel kAll{.registration = true, .tool = true, .joint_offset = true, .geometry = true};

inline constexpr double kRight = std::numbers::pi / 2;

/// Six joints, three of them parallel; tool off the last axis.
inline Chain parallel_arm() {
  constexpr auto r = JointType::revolute;
  return {Convention::standard_dh,
          {link(r, kRight, 0, 0.13), link(r, 0, -0.6, 0), link(r, 0, -0.57, 0), link(r, kRight, 0, 0.16),
           link(r, -kRight, 0, 0.12), link(r, 0, 0, 0.09)},
          {0.05, -0.03, 0.1}};
}

/// A 6-joint elbow arm in modified DH: its alpha and a stand before the joint.
inline Chain modified_arm() {
  constexpr auto r = JointType::revolute;
  return {Convention::modified_dh,
          {link(r, 0, 0, 0.3), link(r, -kRight, 0.1, 0), link(r, 0, 0.6, 0.1), link(r, kRight, 0.05, 0.5),
           link(r, -kRight, 0, 0), link(r, kRight, 0, 0.1)},
          {0.05, 0.02, 0.15}};
}

inline Chain seven_joint_arm() {
  constexpr auto r = JointType::revolute;
  return {Convention::standard_dh,
          {link(r, -kRight, 0, 0.3), link(r, kRight, 0, 0), link(r, -kRight, 0.05, 0.5), link(r, kRight, -0.05, 0),
           link(r, -kRight, 0, 0.4), link(r, kRight, 0.08, 0), link(r, 0, 0, 0.1)},
          {0.1, 0.02, 0.05}};
}

/// Two revolute joints, a prismatic one, and a wrist of three.
inline Chain stanford_arm() {
  constexpr auto r = JointType::revolute;
  return {Convention::standard_dh,
          {link(r, -kRight, 0, 0.4), link(r, kRight, 0, 0.15), link(JointType::prismatic, 0, 0, 0.3),
           link(r, -kRight, 0, 0), link(r, kRight, 0, 0), link(r, 0, 0, 0.2)},
          {0.04, 0.03, 0.1}};
}

/// The data set of `nominal`, and a true robot that stands at its base frame and differs in nothing.
inline KnownArm perfect_arm(const Chain& nominal, Frame frame) {
  KnownArm arm;
  arm.data.robot.chain = nominal;
  arm.data.frame = frame;
  arm.data.file = "poses.csv";
  arm.truth = nominal_robot(arm.data);
  return arm;
}

/// Puts random errors, 1 mm and 2 mrad of standard deviation, into the links that `declared` frees.
inline void misbuild(KnownArm& arm, RandomStream& stream, const DeclaredModel& declared) {
  for (const ParameterId& id : free_parameters(arm.data, declared)) {
    if (id.kind != ParameterId::Kind::link) continue;
    arm.truth.chain.joints[static_cast<std::size_t>(id.index)].parameter(id.link) +=
        (id.is_angle() ? 2e-3 : 1e-3) * stream.normal();
  }
}

inline Eigen::Vector3d random_vector(RandomStream& stream, double deviation) {
  return {deviation * stream.normal(), deviation * stream.normal(), deviation * stream.normal()};
}

/// A pose turned by any angle, and metres away.
inline Eigen::Isometry3d far_pose(RandomStream& stream) {
  const Eigen::Quaterniond turn(stream.normal(), stream.normal(), stream.normal(), stream.normal());
  Eigen::Isometry3d pose(turn.normalized());
  pose.translation() = random_vector(stream, 3.0);
  return pose;
}

/// Adds one pose at the stop as the instrument sees it.
inline void measure(KnownArm& arm, RandomStream& stream, const Instrument& instrument, const Stop& stop,
                    const std::string& target = "") {
  const Eigen::Isometry3d tool = arm.truth.predict(stop, target);
  MeasuredPose pose;
  pose.joints = stop.joints;
  if (stop.approach.size() > 0) pose.approach = stop.approach;
  if (stop.payload_kg > 0) pose.payload_kg = stop.payload_kg;
  pose.temperature_celsius = stop.temperature_celsius;
  pose.time_s = stop.time_s;
  pose.target = target;
  if (instrument.position) pose.position_m = tool.translation() + random_vector(stream, instrument.noise_m);
  if (instrument.orientation) {
    pose.orientation = Eigen::Quaterniond(rotation_of(random_vector(stream, instrument.noise_rad)) * tool.linear());
  }
  for (const Eigen::Vector3d& anchor : arm.data.anchors_m) {
    pose.distances_m.push_back((tool.translation() - anchor).norm() + instrument.noise_m * stream.normal());
  }
  arm.data.poses.push_back(pose);
}

inline void measure(KnownArm& arm, RandomStream& stream, const Instrument& instrument, int poses,
                    const std::string& target = "") {
  for (int i = 0; i < poses; ++i) {
    measure(arm, stream, instrument, random_joints(stream, arm.data.robot.chain), target);
  }
}

inline std::vector<std::size_t> all_poses(const DataSet& data) {
  std::vector<std::size_t> poses(data.poses.size());
  for (std::size_t i = 0; i < poses.size(); ++i) poses[i] = i;
  return poses;
}

inline Fit fit_all(const KnownArm& arm, const DeclaredModel& declared, const FitOptions& options = {}) {
  return fit_declared(arm.data, all_poses(arm.data), declared, nominal_robot(arm.data), options);
}

/// How far the fitted robot's tool is from the true one's, at most, over 50 fresh poses.
inline double largest_error_m(const CorrectedRobot& fitted, const KnownArm& arm, RandomStream& stream,
                              const std::string& target = "") {
  double largest = 0.0;
  for (int i = 0; i < 50; ++i) {
    const JointVector q = random_joints(stream, arm.data.robot.chain);
    const Eigen::Vector3d off = fitted.predict(q, target).translation() - arm.truth.predict(q, target).translation();
    largest = std::max(largest, off.norm());
  }
  return largest;
}

}  // namespace demecal
