#include "fitting/posterior.hpp"

#include "errors/check.hpp"

namespace demecal {

PoseCovariance pose_covariance(const Posterior& posterior, const CorrectedRobot& robot, const Stop& stop,
                               const std::string& target) {
  const auto numbers = static_cast<Eigen::Index>(posterior.ids.size() + posterior.terms.size());
  DEMECAL_CHECK(posterior.factor.rows() == numbers, posterior.factor.rows() << " rows of " << numbers << " numbers");
  const ParameterSpace space(robot, posterior.ids);
  ToolMotion motion;
  space.move_tool(space.at(Eigen::VectorXd::Zero(space.size())), robot.corrected_joints(stop.joints),
                  robot.motions(stop, target), target, motion);
  Eigen::Matrix<double, 6, Eigen::Dynamic> spread =
      motion.twists * posterior.factor.topRows(static_cast<Eigen::Index>(posterior.ids.size()));
  if (posterior.terms.empty()) return spread * spread.transpose();
  const Eigen::Vector3d& tool_m = robot.tool(target).translation();
  Jacobian joints = joint_jacobian(robot.chain, robot.actual_joints(stop), tool_m);
  const Eigen::Matrix3d& base = robot.sensor_from_base.linear();
  joints.topRows<3>() = (base * joints.topRows<3>()).eval();
  joints.bottomRows<3>() = (base * joints.bottomRows<3>()).eval();
  auto row = static_cast<Eigen::Index>(posterior.ids.size());
  for (const CorrectionTerm& term : posterior.terms) {
    spread += term.shape(stop.joints[term.joint]) * joints.col(term.joint) * posterior.factor.row(row++);
  }
  return spread * spread.transpose();
}

}  // namespace demecal
