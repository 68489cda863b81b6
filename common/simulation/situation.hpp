// What a joint goes through at a pose: the command, how it came there, its load, warmth and time.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "data/data_set.hpp"

namespace demecal {

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

}  // namespace demecal
