#include "calibration/joint_targets.hpp"

#include <Eigen/SVD>
#include <algorithm>
#include <cmath>

#include "effects/measurement.hpp"

namespace demecal {
namespace {

/// Half the arm's stretched length: makes metres and radians of like size for the singular values.
double characteristic_length_m(const Chain& chain) {
  double reach = chain.tool_m.norm();
  for (const Joint& joint : chain.joints) reach += std::abs(joint.a_m) + std::abs(joint.d_m);
  return std::max(reach / 2.0, 0.1);
}

Eigen::Vector3d measured_position(const CorrectedRobot& robot, const DataSet& data, const MeasuredPose& pose) {
  if (pose.position_m) return *pose.position_m;
  Eigen::Isometry3d at = robot.predict(Stop(pose), pose.target);
  CorrectedRobot moved = robot;
  for (int iteration = 0; iteration < 5; ++iteration) {
    const Eigen::VectorXd missing = residual(moved, data, pose);
    const Eigen::MatrixXd rows = measurement_jacobian(at, data, pose).leftCols<3>();
    const Eigen::Vector3d step = rows.completeOrthogonalDecomposition().solve(missing);
    moved.sensor_from_base.pretranslate(step);
    at.pretranslate(step);
  }
  return at.translation();
}

Eigen::Isometry3d goal(const CorrectedRobot& robot, const DataSet& data, const MeasuredPose& pose) {
  Eigen::Isometry3d target = robot.predict(Stop(pose), pose.target);
  if (pose.orientation) target.linear() = pose.orientation->toRotationMatrix();
  target.translation() = measured_position(robot, data, pose);
  return target;
}

std::vector<AngleBranch> branches_of(const DataSet& data, std::span<const std::size_t> poses, const Chain& chain) {
  std::vector<AngleBranch> branches(chain.joints.size());
  for (int joint = 0; joint < chain.size(); ++joint) {
    const Joint& link = chain.joints[static_cast<std::size_t>(joint)];
    if (link.type != JointType::revolute) continue;
    std::vector<double> angles;
    for (const std::size_t pose : poses) angles.push_back(data.poses[pose].joints[joint]);
    branches[static_cast<std::size_t>(joint)] = choose_branch(angles, link.lower, link.upper);
  }
  return branches;
}

/// Falls with the square of the distance from the singularity: the joint error's variance grows that way.
double pose_weight(const InverseSolution& solution, const InverseOptions& options) {
  if (solution.status == InverseStatus::diverged) return 0.0;
  return std::min(1.0, std::pow(solution.smallest_singular / options.singular_below, 2));
}

JointVector difference(const Chain& chain, const JointVector& to, const JointVector& from) {
  JointVector change = to - from;
  for (int joint = 0; joint < chain.size(); ++joint) {
    if (chain.joints[static_cast<std::size_t>(joint)].type == JointType::revolute) {
      change[joint] = wrap_near(change[joint], 0.0);
    }
  }
  return change;
}

}  // namespace

JointTargets joint_targets(const DataSet& data, std::span<const std::size_t> poses, const CorrectedRobot& robot) {
  JointTargets targets;
  targets.branches = branches_of(data, poses, robot.chain);
  InverseOptions options;
  options.length_m = characteristic_length_m(robot.chain);
  for (const std::size_t index : poses) {
    const MeasuredPose& pose = data.poses[index];
    const Stop stop(pose);
    const PoseFunction model = [&](const JointVector& q) {
      return robot.predict_with_jacobian(stop.with_joints(q), pose.target);
    };
    const InverseSolution solution = inverse(model, goal(robot, data, pose), pose.joints, options);
    const double weight = pose_weight(solution, options);
    if (weight < 1.0) targets.singular.push_back({index, solution.smallest_singular, solution.status});
    JointVector commanded = pose.joints;
    for (int joint = 0; joint < robot.chain.size(); ++joint) {
      commanded[joint] = targets.branches[static_cast<std::size_t>(joint)](commanded[joint]);
    }
    targets.poses.push_back(index);
    targets.commanded.push_back(commanded);
    targets.error.push_back(difference(robot.chain, solution.q, pose.joints));
    targets.weight.push_back(weight);
  }
  return targets;
}

}  // namespace demecal
