// Arms with weight, stops of them, and the first-order motion of the tool that effects make.
#pragma once

#include <Eigen/Geometry>

#include "effects/effect.hpp"
#include "kinematics/inverse.hpp"
#include "kinematics/random_arm.hpp"

namespace demecal {

/// The kinds of arm that effects must know: joint 3 of the last two slides.
enum class Arm { standard, modified, sliding_standard, sliding_modified };
inline constexpr std::array kArms{Arm::standard, Arm::modified, Arm::sliding_standard, Arm::sliding_modified};

/// Six joints, links of any shape and weight, gravity in any direction.
inline Robot laden_arm(RandomStream& stream, Arm arm) {
  const bool standard = arm == Arm::standard || arm == Arm::sliding_standard;
  Robot robot;
  robot.chain = random_arm(stream, 6, standard ? Convention::standard_dh : Convention::modified_dh);
  if (arm == Arm::sliding_standard || arm == Arm::sliding_modified) {
    Joint& joint = robot.chain.joints[2];
    joint.type = JointType::prismatic;
    joint.lower = -0.5;
    joint.upper = 0.5;
  }
  for (int link = 0; link < 6; ++link) {
    robot.masses.push_back(
        {stream.real(1, 20), {stream.real(-0.2, 0.2), stream.real(-0.2, 0.2), stream.real(-0.2, 0.2)}});
  }
  const Eigen::Vector3d down(stream.normal(), stream.normal(), stream.normal());
  robot.gravity_mps2 = 9.81 * down.normalized();
  robot.balancers = {{0, 0.25, 0.4, 1.2}, {1, 0.5, 0.2, -0.7}};
  return robot;
}

inline Stop random_stop(RandomStream& stream, const Robot& robot) {
  Stop stop(random_joints(stream, robot.chain));
  stop.approach = ApproachSigns(robot.chain.size());
  for (double& sign : stop.approach) sign = stream.chance(0.5) ? 1.0 : -1.0;
  stop.torque = JointVector(robot.chain.size());
  for (double& torque : stop.torque) torque = stream.real(-80.0, 80.0);
  stop.payload_kg = stream.real(0.5, 5.0);
  stop.temperature_celsius = stream.real(22.0, 35.0);
  stop.time_s = stream.real(100.0, 900.0);
  return stop;
}

/// Data that hold everything.
inline Evidence full_evidence(const Robot& robot) {
  Evidence evidence{.approach = true, .payload = true, .temperature = true, .time = true, .masses = true};
  for (const Joint& joint : robot.chain.joints) evidence.joint_ranges.push_back({joint.lower, joint.upper});
  evidence.highest_ratio = 12;
  evidence.stated_ratios = {50.5};
  evidence.logged_weights.assign(
      robot.chain.joints.size(),
      {{"logged_friction", 1.0}, {"logged_zero", -0.5}, {"logged_6_mx", 30.0}, {"logged_6_mass", 80.0}});
  return evidence;
}

/// What a unit motion does to the point `tool_m` (base frame): linear m, angular rad, in the frame of the measurements.
inline PoseError twist_of(const UnitMotion& motion, const ArmState& state, const Eigen::Isometry3d& sensor_from_base,
                          const Eigen::Vector3d& tool_m) {
  const Eigen::Isometry3d frame = motion.place == kSensorPlace
                                      ? Eigen::Isometry3d::Identity()
                                      : sensor_from_base * state.places[static_cast<std::size_t>(motion.place)];
  const Eigen::Vector3d axis = frame.linear().col(motion.axis % 3),
                        lever = sensor_from_base * tool_m - frame.translation();
  PoseError twist;
  if (motion.axis < 3) {
    twist << axis, Eigen::Vector3d::Zero();
  } else {
    twist << axis.cross(lever), axis;
  }
  return twist * motion.size;
}

/// What the effect with its values does to the tool at `state`, to first order; rows as above.
inline PoseError first_order(const Effect& effect, const Robot& robot, const ArmState& state,
                             const Eigen::Isometry3d& sensor_from_base) {
  std::vector<UnitMotion> motions;
  append_unit_motions(effect, robot, state, motions);
  PoseError sum = PoseError::Zero();
  for (const UnitMotion& motion : motions) {
    sum += effect.value(static_cast<std::size_t>(motion.coefficient)) *
           twist_of(motion, state, sensor_from_base, state.payload_point_m);
  }
  return sum;
}

}  // namespace demecal
