#include "calibration/joint_targets.hpp"

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <optional>

#include "decompositions/decompositions.hpp"
#include "effects/arm_state.hpp"
#include "prediction/measurement.hpp"

namespace demecal::inline calibration {
namespace {

constexpr double kPrismaticPerRevolute_m = 0.2;

/// Half the arm's stretched length: makes metres and radians of like size for the singular values.
double characteristic_length_m(const Chain& chain) {
  double reach = chain.tool_m.norm();
  for (const Joint& joint : chain.joints) reach += std::abs(joint.a_m) + std::abs(joint.d_m);
  return std::max(reach / 2.0, 0.1);
}

Eigen::Vector3d measured_position(const CorrectedRobot& robot, const DataSet& data, const MeasuredPose& pose) {
  if (pose.position_m) return measured_point(robot, pose);
  Eigen::Isometry3d tool = robot.predict(Stop(pose), pose.target);
  CorrectedRobot moved = robot;
  for (int iteration = 0; iteration < 5; ++iteration) {
    const Eigen::VectorXd missing = residual(moved, data, pose);
    const Eigen::MatrixXd rows = measurement_jacobian(moved, tool, data, pose).leftCols<3>();
    const Eigen::Vector3d step = least_norm_solution(rows, missing);
    moved.sensor_from_base.pretranslate(step);
    tool.pretranslate(step);
  }
  return tool.translation();
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
    if (!is_revolute(link)) continue;
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
    if (is_revolute(chain, joint)) {
      change[joint] = wrap_near(change[joint], 0.0);
    }
  }
  return change;
}

struct PoseTarget {
  JointVector error;
  double weight = 1.0;
};

/// Makes the target of one pose after another.
class ExactTargets {
 public:
  ExactTargets(const DataSet& data, const CorrectedRobot& robot) : data_(data), robot_(robot) {
    options_.length_m = characteristic_length_m(robot.chain);
  }

  PoseTarget operator()(std::size_t index, std::vector<SingularPose>& singular) const {
    const MeasuredPose& pose = data_.poses[index];
    const Stop stop(pose);
    const PoseFunction model = [&](const JointVector& q) {
      return robot_.predict_with_jacobian(stop.with_joints(q), pose.target);
    };
    const InverseSolution solution = inverse(model, goal(robot_, data_, pose), pose.joints, options_);
    const double weight = pose_weight(solution, options_);
    if (weight < 1.0) singular.push_back({index, solution.smallest_singular, solution.status});
    return {driven_joints(robot_.chain, difference(robot_.chain, solution.q, pose.joints)), weight};
  }

 private:
  const DataSet& data_;
  const CorrectedRobot& robot_;
  InverseOptions options_;
};

JointBelief joint_belief(const Chain& chain, const TargetRule& rule) {
  JointBelief belief{Eigen::VectorXd::Constant(chain.size(), rule.options.joint_error_rad), rule.mean};
  for (int joint = 0; joint < chain.size(); ++joint) {
    if (!is_revolute(chain, joint)) belief.deviation[joint] *= kPrismaticPerRevolute_m;
  }
  return belief;
}

std::vector<PoseTarget> posterior_targets(const DataSet& data, std::span<const std::size_t> poses,
                                          const CorrectedRobot& robot, const TargetRule& rule) {
  const JointBelief belief = joint_belief(robot.chain, rule);
  const RowScales scales = measurement_scales(data, poses, robot, belief, rule.residuals);
  std::vector<PoseTarget> targets;
  for (const std::size_t index : poses) {
    const MeasuredPose& pose = data.poses[index];
    const std::optional<JointVector> errors = most_probable_errors(data, pose, robot, belief, scales);
    targets.push_back(errors ? PoseTarget{*errors} : PoseTarget{JointVector::Zero(pose.joints.size()), 0.0});
  }
  return targets;
}

}  // namespace

JointTargets joint_targets(const DataSet& data, std::span<const std::size_t> poses, const CorrectedRobot& robot,
                           const TargetRule& rule) {
  JointTargets targets;
  targets.branches = branches_of(data, poses, robot.chain);
  std::vector<PoseTarget> found;
  if (rule.options.kind == TargetKind::posterior) {
    found = posterior_targets(data, poses, robot, rule);
  } else {
    const ExactTargets exact(data, robot);
    for (const std::size_t index : poses) found.push_back(exact(index, targets.singular));
  }
  for (std::size_t row = 0; row < poses.size(); ++row) {
    JointVector commanded = data.poses[poses[row]].joints;
    for (int joint = 0; joint < robot.chain.size(); ++joint) {
      commanded[joint] = targets.branches[static_cast<std::size_t>(joint)](commanded[joint]);
    }
    targets.poses.push_back(poses[row]);
    targets.commanded.push_back(commanded);
    targets.error.push_back(found[row].error);
    targets.weight.push_back(found[row].weight);
  }
  return targets;
}

}  // namespace demecal::inline calibration
