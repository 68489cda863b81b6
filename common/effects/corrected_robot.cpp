#include "effects/corrected_robot.hpp"

#include "errors/check.hpp"
#include "kinematics/damped_least_squares.hpp"

namespace demecal {
namespace {

/// rad or m. Errors are thousandths; commands that need more would turn the wrist over to mend an angle of that size.
constexpr double kLargestCorrection = 0.5;

Eigen::Isometry3d tool_at(const Eigen::Vector3d& point_m) {
  return Eigen::Isometry3d(Eigen::Translation3d(point_m));
}

}  // namespace

const Eigen::Isometry3d& CorrectedRobot::tool(const std::string& target) const {
  const auto found = tools.find(target);
  DEMECAL_CHECK(found != tools.end(), "no tool for target '" << target << "'");
  return found->second;
}

JointVector CorrectedRobot::actual_joints(const JointVector& commanded) const {
  DEMECAL_CHECK(commanded.size() == static_cast<Eigen::Index>(corrections.size()),
                commanded.size() << " joint values for " << corrections.size() << " corrections");
  JointVector actual = commanded;
  for (Eigen::Index i = 0; i < actual.size(); ++i) {
    actual[i] += corrections[static_cast<std::size_t>(i)](commanded[i]);
  }
  return actual;
}

Eigen::Isometry3d CorrectedRobot::predict(const JointVector& commanded, const std::string& target) const {
  return sensor_from_base * forward(chain, actual_joints(commanded)) * tool(target);
}

PoseAndJacobian CorrectedRobot::predict_with_jacobian(const JointVector& commanded, const std::string& target) const {
  const Eigen::Isometry3d& flange_from_tool = tool(target);
  const Kinematics at = differential_kinematics(chain, actual_joints(commanded), flange_from_tool.translation());
  PoseAndJacobian result{sensor_from_base * at.flange * flange_from_tool, at.joints};
  const Eigen::Matrix3d rotation = sensor_from_base.linear();
  for (Eigen::Index i = 0; i < result.jacobian.cols(); ++i) {
    const double gain = 1.0 + corrections[static_cast<std::size_t>(i)].slope(commanded[i]);
    result.jacobian.col(i).head<3>() = gain * rotation * at.joints.col(i).head<3>();
    result.jacobian.col(i).tail<3>() = gain * rotation * at.joints.col(i).tail<3>();
  }
  return result;
}

CorrectedRobot nominal_robot(const DataSet& data) {
  CorrectedRobot robot;
  robot.chain = data.robot.chain;
  robot.tools[""] = tool_at(robot.chain.tool_m);
  for (const auto& [target, point_m] : data.tools_m) robot.tools[target] = tool_at(point_m);
  for (const MeasuredPose& pose : data.poses) robot.tools.try_emplace(pose.target, tool_at(nominal_tool(data, pose)));
  robot.corrections.resize(robot.chain.joints.size());
  return robot;
}

InverseSolution corrected_command(const CorrectedRobot& robot, const Chain& nominal, const JointVector& desired,
                                  const InverseOptions& options) {
  const std::string own_tool;
  const Eigen::Isometry3d goal = robot.sensor_from_base * forward(nominal, desired) * robot.tool(own_tool);
  const auto model = [&](const JointVector& commanded) { return robot.predict_with_jacobian(commanded, own_tool); };
  const InverseSolution exact = inverse(model, goal, desired, options);
  const bool converged = exact.status == InverseStatus::converged;
  if (converged && (exact.q - desired).cwiseAbs().maxCoeff() <= kLargestCorrection) return exact;

  InverseSolution nearest = exact;
  nearest.q = damped_least_squares(model, goal, desired);
  const PoseError left = pose_error(robot.predict(nearest.q, own_tool), goal);
  nearest.position_residual_m = left.head<3>().norm();
  nearest.orientation_residual_rad = left.tail<3>().norm();
  if (converged) nearest.status = InverseStatus::damped;
  return nearest;
}

}  // namespace demecal
