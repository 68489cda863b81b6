// A simulated measurement: the robot, its true errors, where it is sent and how well the instrument sees.
#pragma once

#include <Eigen/Geometry>
#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "data/data_set.hpp"
#include "expression/tree.hpp"

namespace demecal {

/// An error of a link parameter, rad or m, joint from 0.
struct GeometryError {
  int joint = 0;
  LinkParameter parameter = LinkParameter::theta;
  double value = 0.0;
};

/// A smooth error of a joint as a formula in theta (rad in, rad out).
struct JointError {
  int joint = 0;
  Tree formula;
};

/// Lost motion of the joint's gear, rad: the joint stops half of it short on either side.
struct Backlash {
  int joint = 0;
  double width_rad = 0.0;
};

/// Gear compliance, rad/Nm, under the weight of the links and the payload.
struct Compliance {
  int joint = 0;
  double rad_per_nm = 0.0;
};

/// A gear's transmission error: cosine rad * cos(N theta) + sine rad * sin(N theta).
struct GearHarmonic {
  int joint = 0;
  double ratio = 1.0;
  double cosine_rad = 0.0;
  double sine_rad = 0.0;
};

struct Scenario {
  std::string name;
  std::string robot_file;                    ///< as written to the data set
  Robot robot;
  std::uint64_t seed = 1;

  // where the robot is sent
  Eigen::Vector3d box_corner_m = Eigen::Vector3d::Zero();   ///< of the tool-point cuboid, base frame
  Eigen::Vector3d box_size_m = Eigen::Vector3d::Zero();
  JointVector home;                          ///< joints whose orientation the poses vary around
  double orientation_spread_rad = 0.0;       ///< half width of the random tilt about each axis
  bool by_joints = false;                    ///< draw joints uniformly within limits (or joint_ranges) instead of in the cuboid
  std::vector<std::array<double, 2>> joint_ranges;          ///< rad or m; empty: the robot's limits
  std::array<int, 3> poses{30, 30, 0};       ///< calibration, validation, accept
  int repeats = 1;

  // how it is measured
  Eigen::Isometry3d sensor_from_base = Eigen::Isometry3d::Identity();
  double noise_m = 0.0;                      ///< standard deviation per axis
  bool orientation_measured = false;
  double orientation_noise_rad = 0.0;
  Eigen::Vector3d tool_error_m = Eigen::Vector3d::Zero();
  std::vector<double> payloads_kg;           ///< drawn per pose; empty: no payload column
  bool approach_recorded = true;

  // what is wrong with it
  std::vector<GeometryError> geometry;
  std::vector<JointError> joint_errors;
  std::vector<Backlash> backlash;
  std::vector<Compliance> compliance;
  std::vector<GearHarmonic> gear_harmonics;
};

}  // namespace demecal
