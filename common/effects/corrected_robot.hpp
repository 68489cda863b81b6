// The robot as it really is: identified geometry, base and tool, and what its joints do wrong.
#pragma once

#include <Eigen/Geometry>
#include <map>
#include <string>
#include <vector>

#include "data/data_set.hpp"
#include "effects/joint_correction.hpp"
#include "kinematics/inverse.hpp"

namespace demecal {

/// Predicts where the real robot goes when it is commanded to given joints:
/// sensor_from_base * forward(chain, q + g(q)) * tool.
struct CorrectedRobot {
  Chain chain;  ///< with identified parameters
  Eigen::Isometry3d sensor_from_base = Eigen::Isometry3d::Identity();
  std::map<std::string, Eigen::Isometry3d> tools;  ///< flange_from_tool of every target; "" is the robot's own
  std::vector<JointCorrection> corrections;        ///< one per joint

  /// flange_from_tool of a target; the robot must have it.
  const Eigen::Isometry3d& tool(const std::string& target) const;
  /// q + g(q).
  JointVector actual_joints(const JointVector& commanded) const;
  /// Pose of the tool in the frame of the measurements, at commanded joints.
  Eigen::Isometry3d predict(const JointVector& commanded, const std::string& target) const;
  /// The same with its Jacobian by the commanded joints (corrections' slopes included), rows in the measurements'
  /// frame.
  PoseAndJacobian predict_with_jacobian(const JointVector& commanded, const std::string& target) const;
};

/// The robot of the data set with nothing identified: nominal chain, the sensor's frame taken as the base, nominal
/// tools, neutral corrections. It has a tool for every target the set or any of its poses names.
CorrectedRobot nominal_robot(const DataSet& data);

/// The joints to command so that the real robot arrives where the nominal robot, in the same base and with the same
/// tool, would stand at `desired`: the exact inverse of the full model, for the robot's own tool, found from `desired`
/// so that the arm keeps its configuration. Where there is no such inverse within half a radian (or metre) of `desired`
/// in every joint (near a singularity, with fewer than 6 joints, out of reach) it is damped least squares, position
/// first, orientation as far as small motions go: the status then is not `converged`, and the residuals say what
/// remains.
InverseSolution corrected_command(const CorrectedRobot& robot, const Chain& nominal, const JointVector& desired,
                                  const InverseOptions& options = {});

}  // namespace demecal
