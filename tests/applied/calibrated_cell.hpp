// A simulated arm that is wrong in a known way, and the model that a calibration of it finds from noisy poses.
#pragma once

#include <cmath>

#include "closed_calibration/calibrated_model.hpp"
#include "kinematics/angles.hpp"
#include "prediction/random_robot.hpp"
#include "programs/correct_program.hpp"

namespace demecal {

struct CalibratedCell {
  Robot nominal;
  CommandModel truth;  ///< predicts where the arm really goes
  CommandModel model;  ///< what was found
  bool fitted = false;
  bool ordinary = false;  ///< many poses of position and orientation, or of a point well off the last axis
  JointVector middle;     ///< of the measured ranges
};

inline Joint link_of(double alpha_rad, double a_m, double d_m) {
  Joint joint;
  joint.alpha_rad = alpha_rad;
  joint.a_m = a_m;
  joint.d_m = d_m;
  joint.upper = 2.96;
  joint.lower = -joint.upper;
  return joint;
}

/// 0: six joints, spherical wrist; 1: six joints, offset wrist; 2: seven joints; 3: the first on a rail.
inline Chain cell_arm(RandomStream& stream, int kind) {
  constexpr double kRight = std::numbers::pi / 2;
  const auto about = [&](double length_m) { return length_m * stream.real(0.8, 1.2); };
  Chain chain;
  if (kind == 0 || kind == 3) {
    chain.joints = {link_of(-kRight, about(0.15), about(0.4)),
                    link_of(0, about(0.6), 0),
                    link_of(-kRight, about(0.1), 0),
                    link_of(kRight, 0, about(0.6)),
                    link_of(-kRight, 0, 0),
                    link_of(0, 0, about(0.1))};
  } else if (kind == 1) {
    chain.joints = {link_of(kRight, 0, about(0.16)), link_of(0, -about(0.6), 0),       link_of(0, -about(0.55), 0),
                    link_of(kRight, 0, about(0.17)), link_of(-kRight, 0, about(0.12)), link_of(0, 0, about(0.1))};
  } else {
    chain.joints = {link_of(-kRight, 0, about(0.34)), link_of(kRight, 0, 0),           link_of(kRight, 0, about(0.4)),
                    link_of(-kRight, 0, 0),           link_of(-kRight, 0, about(0.4)), link_of(kRight, 0, 0),
                    link_of(0, 0, about(0.13))};
  }
  if (kind == 3) {
    // Along x of the base frame, the arm upright on it.
    chain.base = Eigen::AngleAxisd(kRight, Eigen::Vector3d::UnitY());
    Joint rail = link_of(-kRight, 0, 0);
    rail.type = JointType::prismatic;
    rail.theta_rad = kRight;
    rail.lower = 0.0;
    rail.upper = 3.0;
    chain.joints.front().theta_rad = -kRight;
    chain.joints.insert(chain.joints.begin(), rail);
  }
  const bool on_axis = stream.chance(0.3);
  chain.tool_m = {on_axis ? 0.0 : stream.real(0.05, 0.15), on_axis ? 0.0 : stream.real(-0.1, 0.1),
                  stream.real(0.05, 0.2)};
  return chain;
}

/// The arm with errors of a millimetre and a milliradian; where its base and its first joint's zero are is a matter of
/// words, and they stay.
inline CorrectedRobot erring_arm(RandomStream& stream, const Robot& nominal) {
  CorrectedRobot robot;
  robot.chain = nominal.chain;
  const bool railed = !is_revolute(nominal.chain, 0);
  for (std::size_t i = 0; i < robot.chain.joints.size(); ++i) {
    Joint& joint = robot.chain.joints[i];
    if (i > 0) joint.theta_rad += stream.normal() * 1e-3;
    if (i > (railed ? 1 : 0)) joint.d_m += stream.normal() * 3e-4;
    if (i > 0 || !railed) joint.a_m += stream.normal() * 3e-4;
    joint.alpha_rad += stream.normal() * 5e-4;
  }
  robot.corrections.assign(robot.chain.joints.size(), {});
  robot.tools[""] = Eigen::Isometry3d(Eigen::Translation3d(nominal.chain.tool_m));
  robot.tools[""].translation() += 3e-4 * Eigen::Vector3d(stream.normal(), stream.normal(), stream.normal());
  robot.described = nominal;
  return robot;
}

inline JointVector joints_about(RandomStream& stream, const JointVector& middle, double half_range) {
  return middle + random_change(stream, static_cast<int>(middle.size()), half_range);
}

/// Away from stretched elbows and straight wrists.
inline JointVector middle_of(RandomStream& stream, int kind) {
  JointVector middle(kind >= 2 ? 7 : 6);
  if (kind == 0) middle << 0.2, -0.9, 0.6, 0.1, 0.9, 0.3;
  if (kind == 1) middle << 0.3, -1.2, 1.4, -1.3, -1.5, 0.2;
  if (kind == 3) middle << 1.5, 0.2, -0.9, 0.6, 0.1, 0.9, 0.3;
  if (kind == 2) middle << 0.1, 0.5, 0.2, -1.2, 0.3, 0.9, 0.1;
  return middle + random_change(stream, static_cast<int>(middle.size()), 0.2);
}

inline CommandModel commands_of(const Robot& nominal, const CorrectedRobot& robot) {
  return command_model(nominal, robot,
                       std::vector<double>(nominal.chain.joints.size(), std::numeric_limits<double>::infinity()));
}

inline CalibratedCell calibrated_cell(RandomStream& stream, int kind) {
  CalibratedCell cell;
  cell.nominal.chain = cell_arm(stream, kind);
  CorrectedRobot real = erring_arm(stream, cell.nominal);
  cell.truth = commands_of(cell.nominal, real);
  cell.middle = middle_of(stream, kind);
  real.sensor_from_base = random_pose(stream);

  DataSet data;
  data.robot = cell.nominal;
  const bool orientation = stream.chance(0.4), many = stream.chance(0.7);
  const double noise_m = stream.real(1e-5, 8e-5), half_range = stream.real(0.6, 1.1);
  const std::size_t poses = many ? 60 + stream.index(60) : 18 + stream.index(12);
  for (std::size_t i = 0; i < poses; ++i) {
    MeasuredPose pose;
    pose.joints = joints_about(stream, cell.middle, half_range);
    const Eigen::Isometry3d seen = real.predict(Stop(pose.joints), "");
    pose.position_m = seen.translation() + noise_m * Eigen::Vector3d(stream.normal(), stream.normal(), stream.normal());
    const Eigen::Vector3d turn =
        2.0 * noise_m / 0.3 * Eigen::Vector3d(stream.normal(), stream.normal(), stream.normal());
    if (orientation) pose.orientation = Eigen::Quaterniond(rotation_of(turn) * seen.linear());
    data.poses.push_back(pose);
  }
  const DeclaredModel declared{.registration = true, .tool = true, .joint_offset = true, .geometry = true};
  const Fit fit = fit_declared(data, poses_of(data, PoseSet::calibration), declared, nominal_robot(data));
  cell.fitted = fit.status == FitStatus::converged;
  if (!cell.fitted) return cell;
  const Calibration calibration{.robot = fit.robot, .estimates = fit.estimates, .joints = {}, .unseen = {}};
  const CorrectedRobot found = without_base(fit.robot, cell.nominal.chain);
  cell.model = with_posterior(commands_of(cell.nominal, found), found, posterior_of(data, declared, calibration),
                              measured_ranges(data, calibration), true);
  const bool off_axis = cell.nominal.chain.tool_m.head<2>().norm() > 0.03;
  cell.ordinary = many && (orientation || off_axis);
  return cell;
}

}  // namespace demecal
