// How a simulated arm stands, axis by axis, also where its axes tilt in their bearings, and the weight that each joint
// feels.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <span>
#include <vector>

#include "data/data_set.hpp"
#include "kinematics/chain.hpp"

namespace demecal::inline simulation {

/// Frames of a standing arm in the base frame.
struct Stance {
  std::vector<Eigen::Isometry3d> axes;   ///< per joint: z is its axis, before the joint's own motion
  std::vector<Eigen::Isometry3d> links;  ///< per link: its own frame
  Eigen::Isometry3d flange;
};

/// Frames of `chain` at joint values `q` (rad or m). `tilts` are rotation vectors (rad), one per joint in its axis
/// frame, by which each axis stands off its nominal direction; empty: none do.
Stance stand(const Chain& chain, const JointVector& q, std::span<const Eigen::Vector3d> tilts = {});

/// The rotation by a rotation vector, rad.
Eigen::Quaterniond rotation_by(const Eigen::Vector3d& vector_rad);

/// What gravity does to one joint, in the frame whose z is the joint's axis, before the joint's own motion.
struct JointLoad {
  Eigen::Vector3d force_n = Eigen::Vector3d::Zero();
  Eigen::Vector3d moment_nm = Eigen::Vector3d::Zero();  ///< about the frame's origin
  double effort = 0.0;  ///< what pushes the joint itself along its axis: Nm for revolute, N for prismatic joints
};

/// Everything an error of the arm may depend on.
struct Situation {
  JointVector commanded;         ///< rad or m
  ApproachSigns approach;        ///< -1, 0 or +1
  std::vector<JointLoad> loads;  ///< one per joint
  double warming_kelvin = 0.0;   ///< above the temperature at which the arm is nominal
  double time_s = 0.0;           ///< since the first pose
};

/// What gravity does to every joint of the nominal arm standing at `q` (rad or m) with `payload_kg` at its tool point:
/// the sum over all links the joint carries of weight and of lever x weight. Unknown masses weigh nothing.
std::vector<JointLoad> gravity_loads(const Robot& robot, const JointVector& q, double payload_kg);

}  // namespace demecal::inline simulation
