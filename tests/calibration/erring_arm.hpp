// A measured arm whose true joint errors the test chose.
#pragma once

#include <Eigen/Geometry>
#include <cmath>
#include <vector>

#include "calibration/joint_targets.hpp"
#include "expression/text.hpp"
#include "prediction/corrected_robot.hpp"
#include "random/random_stream.hpp"

namespace demecal {

/// The thesis's.
inline const TargetRule kExactTargets{.options = {.kind = TargetKind::exact}};

/// The PUMA 761 of the thesis, Table A-1.
inline Chain puma() {
  Chain chain;
  const double right = M_PI / 2;
  const double alpha[] = {-right, 0, right, -right, right, 0}, a[] = {0, 0.65, 0, 0, 0, 0},
               d[] = {0, 0.191, 0, 0.6, 0, 0.125};
  for (int i = 0; i < 6; ++i) {
    chain.joints.push_back({.d_m = d[i], .a_m = a[i], .alpha_rad = alpha[i], .lower = -M_PI, .upper = M_PI});
  }
  chain.tool_m = {0.15025, 0.00163, 0.05569};
  return chain;
}

/// The true robot: the PUMA with joint errors g(theta) of every joint by their texts; empty text: none.
inline CorrectedRobot true_puma(const std::vector<std::string>& errors) {
  CorrectedRobot robot;
  robot.chain = puma();
  robot.tools[""] = Eigen::Isometry3d(Eigen::Translation3d(robot.chain.tool_m));
  for (const std::string& text : errors) {
    robot.corrections.push_back(text.empty() ? JointCorrection{} : JointCorrection(parse(text), {}, {-M_PI, M_PI}));
  }
  return robot;
}

/// Poses of the true robot, measured in its base frame with noise of `noise_m` per axis; a third validate.
inline DataSet measure(const CorrectedRobot& truth, int poses, double noise_m, std::uint64_t seed, bool orientation) {
  RandomStream random{seed, 4711};
  DataSet data;
  data.name = "erring";
  data.file = "erring.csv";
  data.frame = Frame::base;
  data.robot.name = "PUMA";
  data.robot.chain = puma();
  for (int i = 0; i < poses; ++i) {
    MeasuredPose pose;
    pose.joints.resize(6);
    for (int joint = 0; joint < 6; ++joint) pose.joints[joint] = random.real(-1.3, 1.3);
    pose.joints[2] += 1.6;  // elbow bent
    pose.joints[4] = random.real(0.5, 1.5) * (i % 2 == 0 ? 1 : -1);
    const Eigen::Isometry3d there = truth.predict(pose.joints, "");
    pose.position_m =
        there.translation() + noise_m * Eigen::Vector3d(random.normal(), random.normal(), random.normal());
    if (orientation) pose.orientation = Eigen::Quaterniond(there.linear());
    pose.set = i % 3 == 2 ? PoseSet::validation : PoseSet::calibration;
    pose.pose_id = std::string("P").append(std::to_string(i + 1));
    data.poses.push_back(pose);
  }
  return data;
}

}  // namespace demecal
