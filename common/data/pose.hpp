// One measured pose: what the robot was told, what the instrument saw, and the circumstances.
#pragma once

#include <Eigen/Geometry>
#include <optional>
#include <string>
#include <string_view>

#include "kinematics/chain.hpp"

namespace demecal {

/// What a pose is used for: fitting, choosing, or the one final judgement.
enum class PoseSet { calibration, validation, accept };

/// As data sets and reports name it.
std::string_view to_string(PoseSet set);

/// -1, 0 or +1 per joint: the sign of its last motion before the pose.
using ApproachSigns = Eigen::Matrix<double, Eigen::Dynamic, 1, 0, kMaxJoints, 1>;

struct MeasuredPose {
  JointVector joints;                             ///< commanded, rad or m
  std::optional<Eigen::Vector3d> position_m;      ///< measured tool point
  std::optional<Eigen::Quaterniond> orientation;  ///< measured, unit
  std::vector<double> distances_m;                ///< measured from fixed points, in the order of DataSet::anchors
  std::optional<ApproachSigns> approach;
  std::optional<double> payload_kg;
  std::optional<double> temperature_celsius;
  std::optional<double> time_s;
  PoseSet set = PoseSet::calibration;
  std::string pose_id;   ///< equal ids are repeats of one pose
  std::string target;    ///< which point on the tool; empty: the robot's own tool
  std::size_t line = 0;  ///< where it stands in its file
};

}  // namespace demecal
