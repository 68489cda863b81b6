// The robot as it really is: identified geometry, base and tool, and what its joints do wrong.
#pragma once

#include <Eigen/Geometry>
#include <map>
#include <string>
#include <vector>

#include "data/data_set.hpp"
#include "effects/displacement.hpp"
#include "effects/joint_correction.hpp"
#include "kinematics/inverse.hpp"

namespace demecal {

/// Predicts where the real robot goes when it is commanded to given joints:
/// sensor_from_base * forward(chain, q + g(q)) * tool, with the small motions that the effects make put in at their
/// places, and those of the instrument before all.
struct CorrectedRobot {
  Chain chain;  ///< with identified parameters
  Eigen::Isometry3d sensor_from_base = Eigen::Isometry3d::Identity();
  std::map<std::string, Eigen::Isometry3d> tools;  ///< flange_from_tool of every target; "" is the robot's own
  std::vector<JointCorrection> corrections;        ///< one per joint
  std::vector<Effect> effects{};                   ///< what else the arm does, by how `described` stands
  Robot described{};  ///< the arm as its maker describes it; needed where there are effects

  /// flange_from_tool of a target; the robot must have it.
  const Eigen::Isometry3d& tool(const std::string& target) const;
  /// q + g(q).
  JointVector corrected_joints(const JointVector& commanded) const;
  /// The same, and what the effects add about or along the joints' axes.
  JointVector actual_joints(const Stop& stop) const;
  /// Unit motions of the effects at a stop with the tool of `target`. They depend on the model's numbers only where an
  /// effect depends on where the tool is seen, and there on where it would be without effects.
  std::vector<EffectMotion> motions(const Stop& stop, const std::string& target) const;

  /// Pose of the tool in the frame of the measurements, at commanded joints and their circumstances.
  Eigen::Isometry3d predict(const Stop& stop, const std::string& target) const;
  /// The same from joints already corrected and motions already known.
  Eigen::Isometry3d predict(const JointVector& corrected, const std::vector<EffectMotion>& motions,
                            const std::string& target) const;
  /// The pose with its Jacobian by the commanded joints, rows in the measurements' frame: corrections' slopes included,
  /// but not those of the effects, which are taken to stay as they are at `stop` (their slopes are a hundredth of the
  /// joints' own at most, so that Newton's steps still converge).
  PoseAndJacobian predict_with_jacobian(const Stop& stop, const std::string& target) const;
};

/// The robot of the data set with nothing identified: nominal chain, the sensor's frame taken as the base, nominal
/// tools, neutral corrections. It has a tool for every target the set or any of its poses names.
CorrectedRobot nominal_robot(const DataSet& data);

/// The joints to command so that the real robot arrives where the nominal robot, in the same base and with the same
/// tool, would stand at `desired`: the exact inverse of the full model, for the robot's own tool, found from `desired`
/// so that the arm keeps its configuration. Approach, payload, temperature and time are taken as given. Where there is
/// no such inverse within half a radian (or metre) of `desired` in every joint (near a singularity, with fewer than 6
/// joints, out of reach) it is damped least squares, position first, orientation as far as small motions go: the status
/// then is not `converged`, and the residuals say what remains.
InverseSolution corrected_command(const CorrectedRobot& robot, const Chain& nominal, const Stop& desired,
                                  const InverseOptions& options = {});

}  // namespace demecal
