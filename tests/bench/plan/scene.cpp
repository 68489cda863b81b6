#include "scene.hpp"

#include <cmath>

#include "data_files/robot_file.hpp"
#include "fitting/fit.hpp"

namespace demecal::bench {
namespace {

Robot seven_joints() {
  Robot robot;
  robot.name = "seven joints";
  const auto link = [&](double alpha_deg, double d_m) {
    Joint joint;
    joint.alpha_rad = alpha_deg * M_PI / 180.0;
    joint.d_m = d_m;
    joint.lower = -2.6;
    joint.upper = 2.6;
    robot.chain.joints.push_back(joint);
  };
  link(-90, 0.34);
  link(90, 0.0);
  link(90, 0.4);
  link(-90, 0.0);
  link(-90, 0.4);
  link(90, 0.0);
  link(0, 0.126);
  robot.chain.tool_m = {0.06, 0.02, 0.1};
  return robot;
}

}  // namespace

std::vector<Robot> arms() {
  std::vector<Robot> all;
  for (const char* name : {"puma761", "ur10", "elbow-offset"})
    all.push_back(load_robot(std::string(DEMECAL_SOURCE_DIR) + "/configs/robots/" + name + ".yaml"));
  all.push_back(seven_joints());
  for (Robot& robot : all)
    if (robot.chain.tool_m.head<2>().norm() < 0.02) robot.chain.tool_m += Eigen::Vector3d(0.08, 0.03, 0.0);
  return all;
}

CorrectedRobot truth_of(const Robot& robot, RandomStream& random) {
  DataSet empty;
  empty.robot = robot;
  CorrectedRobot truth = nominal_robot(empty);
  for (Joint& joint : truth.chain.joints) {
    joint.theta_rad += 1e-3 * random.normal();
    joint.alpha_rad += 1e-3 * random.normal();
    joint.a_m += 1e-3 * random.normal();
    joint.d_m += 1e-3 * random.normal();
  }
  truth.tools.at("").translation() += 1e-3 * Eigen::Vector3d(random.normal(), random.normal(), random.normal());
  truth.sensor_from_base.translation() = Eigen::Vector3d(2.0, 1.0, 0.5);
  truth.sensor_from_base.linear() = Eigen::AngleAxisd(0.7, Eigen::Vector3d::UnitZ()).toRotationMatrix();
  return truth;
}

DataSet measured(const Robot& robot, const CorrectedRobot& truth, const std::vector<PlannedPose>& poses,
                 RandomStream& random) {
  DataSet data;
  data.robot = robot;
  data.name = data.file = "bench";
  for (const PlannedPose& pose : poses) {
    MeasuredPose one;
    one.joints = pose.joints;
    one.approach = pose.approach;
    one.pose_id = std::to_string(data.poses.size());
    Stop stop(pose.joints);
    stop.approach = pose.approach;
    one.position_m = truth.predict(stop, "").translation() +
                     kNoise_m * Eigen::Vector3d(random.normal(), random.normal(), random.normal());
    data.poses.push_back(std::move(one));
  }
  return data;
}

double true_error_m(const CorrectedRobot& model, const CorrectedRobot& truth, const std::vector<PlannedPose>& places) {
  double sum = 0.0;
  for (const PlannedPose& place : places)
    sum +=
        (model.predict(place.joints, "").translation() - truth.predict(place.joints, "").translation()).squaredNorm();
  return std::sqrt(sum / static_cast<double>(places.size()));
}

CorrectedRobot fitted(const DataSet& data) {
  std::vector<std::size_t> all = poses_of(data, PoseSet::calibration);
  return fit_declared(data, all, kLinks, nominal_robot(data)).robot;
}

}  // namespace demecal::bench
