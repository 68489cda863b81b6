// How the nominal arm stands at a stop: where it was commanded, its circumstances, its axes, and its masses' weight on
// each of them.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <optional>
#include <utility>
#include <vector>

#include "data/data_set.hpp"
#include "kinematics/chain.hpp"

namespace demecal::inline effects {

/// One stop of the robot: where it was commanded, and the circumstances that its errors depend on.
struct Stop {
  JointVector joints;                           ///< commanded, rad or m
  ApproachSigns approach;                       ///< -1, 0 or +1 per joint; empty: unknown, taken as 0
  JointVector torque{};                         ///< of the drives, as logged, Nm or N; empty: unknown, taken as 0
  double payload_kg = 0.0;                      ///< at the tool point
  bool payload_stated = true;                   ///< otherwise it is taken so, and may be another
  std::optional<double> temperature_celsius{};  ///< none: effects take the arm to be at their reference
  std::optional<double> time_s{};               ///< none: effects take the stop to be at their reference

  /// A command alone: no approach, nothing carried, nothing known of warmth and time.
  Stop(JointVector commanded) : joints(std::move(commanded)) {}  // NOLINT(google-explicit-constructor)
  /// The same of an expression such as a sum of joint vectors.
  template <typename Joints>
  Stop(const Eigen::MatrixBase<Joints>& commanded) : joints(commanded) {}  // NOLINT(google-explicit-constructor)
  explicit Stop(const MeasuredPose& pose);

  /// The same circumstances at other joints.
  Stop with_joints(const JointVector& commanded) const;
};

/// The places of an arm at which effects move it: place i < n is the frame whose z is the axis of joint i (from 0),
/// before the joint's own motion; place n is the flange; kSensorPlace is the frame of the measurements.
inline constexpr int kSensorPlace = -1;

/// Weight at one place, in that place's frame.
struct PlaceLoad {
  Eigen::Vector3d force_n = Eigen::Vector3d::Zero();
  Eigen::Vector3d moment_nm = Eigen::Vector3d::Zero();  ///< about the place's origin
};

/// Everything an effect may depend on, at the commanded joints of the nominal arm.
struct ArmState {
  Stop stop;
  JointVector driven;                     ///< where the drives then turn the joints
  std::vector<Eigen::Isometry3d> places;  ///< n + 1, in the base frame
  std::vector<Eigen::Isometry3d> links;   ///< n: the frame fixed in each link, in the base frame
  std::vector<PlaceLoad> loads;           ///< n: of all links and the payload beyond; known masses only
  Eigen::Vector3d gravity_mps2;           ///< base frame
  Eigen::Vector3d payload_point_m;        ///< where the payload hangs: the nominal tool point, base frame
  Eigen::Vector3d tool_in_sensor_m;       ///< the tool point in the frame of the measurements

  const JointVector& joints() const { return stop.joints; }
  /// The sign of the joint's last motion; 0 where unknown.
  double approach(int joint) const { return stop.approach.size() > 0 ? stop.approach[joint] : 0.0; }
  /// By which the joint's drive was logged to hold it; 0 where unknown.
  double drive_torque(int joint) const { return stop.torque.size() > 0 ? stop.torque[joint] : 0.0; }
  /// What gravity does to the joint along its axis: Nm for revolute, N for prismatic joints.
  double torque(const Chain& chain, int joint) const;
};

/// The state of `robot` at `stop`; the tool point in the sensor's frame is set by the caller who knows it.
ArmState arm_state(const Robot& robot, const Stop& stop);

}  // namespace demecal::inline effects
