// A simulated measurement: the robot, its true errors, where it is sent and how well the instrument sees.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "data/contacts.hpp"
#include "data/data_set.hpp"
#include "kinematics/chain.hpp"
#include "simulation/truth.hpp"

namespace demecal::inline simulation {

/// A point that the robot touches.
struct TouchedPoint {
  std::string contact;
  Eigen::Vector3d at_m = Eigen::Vector3d::Zero();  ///< base frame
  bool for_acceptance = false;                     ///< touched by accept poses only
};

/// How the drives' torques are logged.
struct TorqueLog {
  double noise = 0.0;     ///< standard deviation, Nm or N
  double friction = 0.0;  ///< by which a joint that moved up needs more, and one that moved down less
};

/// What is wrong with it is its TrueErrors.
struct Scenario : TrueErrors {
  std::string name;
  std::string robot_file;  ///< as written to the data set
  Robot robot;
  std::uint64_t seed = 1;

  // where the robot is sent
  Eigen::Vector3d box_corner_m = Eigen::Vector3d::Zero();  ///< of the tool-point cuboid, base frame
  Eigen::Vector3d box_size_m = Eigen::Vector3d::Zero();
  JointVector home;                     ///< joints whose orientation the poses vary around
  double orientation_spread_rad = 0.0;  ///< half width of the random tilt about each axis
  bool by_joints = false;  ///< draw joints uniformly within limits (or joint_ranges) instead of in the cuboid
  std::vector<std::array<double, 2>> joint_ranges;  ///< rad or m; empty: the robot's limits
  std::array<int, 3> poses{30, 30, 0};              ///< calibration, validation, accept
  int repeats = 1;

  // how it is measured
  Eigen::Isometry3d sensor_from_base = Eigen::Isometry3d::Identity();
  double noise_m = 0.0;  ///< standard deviation per axis
  bool orientation_measured = false;
  double orientation_noise_rad = 0.0;
  std::vector<double> payloads_kg;  ///< drawn per pose; empty: no payload column
  bool approach_recorded = true;
  std::optional<TorqueLog> torque_log{};  ///< none: torques are not logged

  // or what it touches in place of being measured
  std::vector<TouchedPoint> touched;           ///< empty: it is measured
  double play_m = 0.0;                         ///< of the tool there, standard deviation per axis
  std::vector<KnownDistance> known_distances;  ///< as the data set states them

  // its circumstances
  double seconds_per_pose = 0.0;                 ///< time from one measurement to the next; 0: no time column
  std::optional<TemperatureCourse> temperature;  ///< none: no temperature column, and nothing warms up
  double reference_celsius = 20.0;               ///< the temperature at which the arm is nominal
};

/// Throws InputError where the scenario contradicts itself or its robot, naming the key and the rule.
void check(const Scenario& scenario);

}  // namespace demecal::inline simulation
