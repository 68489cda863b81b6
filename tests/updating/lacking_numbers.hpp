// Simulated measurements of an arm with errors in its links, and models of it.
#pragma once

#include "closed_calibration/calibrated_model.hpp"
#include "fitting/fit.hpp"
#include "kinematics/random_arm.hpp"

namespace demecal {

inline constexpr double kMeasured_m = 3e-5;

inline Robot wrist_robot() {
  Robot robot;
  robot.name = "wrist";
  robot.chain = wrist_arm();
  robot.chain.joints.front().d_m = 0.5;
  robot.chain.tool_m = {0.12, 0.05, 0.1};
  return robot;
}

inline CorrectedRobot true_wrist(std::uint64_t seed) {
  RandomStream random{9300, seed};
  DataSet data;
  data.robot = wrist_robot();
  CorrectedRobot truth = nominal_robot(data);
  for (Joint& joint : truth.chain.joints) {
    joint.theta_rad += 1e-3 * random.normal();
    joint.alpha_rad += 1e-3 * random.normal();
    joint.a_m += 1e-3 * random.normal();
  }
  truth.sensor_from_base.translation() = Eigen::Vector3d(1.0, 2.0, 0.3);
  return truth;
}

inline DataSet measured_wrist(const CorrectedRobot& truth, int calibration, int validation, std::uint64_t seed) {
  RandomStream random{9301, seed};
  DataSet data;
  data.robot = wrist_robot();
  data.file = data.name = "wrist";
  for (int i = 0; i < calibration + validation; ++i) {
    MeasuredPose pose;
    pose.joints = random_joints(random, data.robot.chain);
    pose.set = i < calibration ? PoseSet::calibration : PoseSet::validation;
    pose.pose_id = std::to_string(i);
    pose.position_m = truth.predict(pose.joints, "").translation() +
                      kMeasured_m * Eigen::Vector3d(random.normal(), random.normal(), random.normal());
    data.poses.push_back(pose);
  }
  return data;
}

inline CalibratedModel model_of_wrist(const DataSet& data) {
  const DeclaredModel links{.registration = true, .tool = true, .joint_offset = true, .geometry = true};
  CalibratedModel model;
  model.nominal = data.robot;
  model.declared = links;
  model.robot = fit_declared(data, poses_of(data, PoseSet::calibration), links, nominal_robot(data)).robot;
  const FittedPosterior fitted = fitted_posterior(data, links, model.robot, poses_of(data, PoseSet::calibration));
  model.posterior = fitted.posterior;
  model.interval = prediction_interval(data, fitted, model.robot);
  for (int joint = 0; joint < data.robot.chain.size(); ++joint) model.measured.push_back({-3.1, 3.1});
  return model;
}

}  // namespace demecal
