// Random corrections and corrected robots for property tests.
#pragma once

#include <Eigen/Geometry>

#include "kinematics/random_arm.hpp"
#include "prediction/corrected_robot.hpp"

namespace demecal {

/// amplitude * SIN(theta * frequency + phase): smooth, of known size.
inline Tree wave(double amplitude, double frequency, double phase) {
  const Tree argument = apply(Primitive::add, apply(Primitive::multiply, variable_tree(0), constant_tree(frequency)),
                              constant_tree(phase));
  return apply(Primitive::multiply, constant_tree(amplitude), apply(Primitive::sine, argument));
}

inline JointCorrection random_correction(RandomStream& stream, double amplitude, Interval range) {
  return {wave(stream.real(-amplitude, amplitude), stream.real(0.3, 2.0), stream.real(-3.0, 3.0)), {}, range};
}

inline Eigen::Isometry3d random_pose(RandomStream& stream) {
  const Eigen::Quaterniond turn(stream.normal(), stream.normal(), stream.normal(), stream.normal());
  Eigen::Isometry3d pose(turn.normalized());
  pose.translation() = Eigen::Vector3d(stream.real(-2, 2), stream.real(-2, 2), stream.real(-2, 2));
  return pose;
}

/// `nominal` made real: link parameters off by up to `geometry_error`, waves up to `amplitude` in every joint, anywhere
/// seen from the instrument, with a tool for the targets "" and "B".
inline CorrectedRobot random_robot(RandomStream& stream, const Chain& nominal, double geometry_error,
                                   double amplitude) {
  CorrectedRobot robot;
  robot.chain = nominal;
  for (Joint& joint : robot.chain.joints) {
    for (int i = 0; i < kLinkParameters; ++i) {
      joint.parameter(static_cast<LinkParameter>(i)) += stream.real(-geometry_error, geometry_error);
    }
    robot.corrections.push_back(random_correction(stream, amplitude, {-4.0, 4.0}));
  }
  robot.sensor_from_base = random_pose(stream);
  robot.tools[""] = Eigen::Isometry3d(Eigen::Translation3d(nominal.tool_m));
  robot.tools["B"] = random_pose(stream);
  return robot;
}

}  // namespace demecal
