#include "effects/command.hpp"

#include "kinematics/damped_least_squares.hpp"

namespace demecal {
namespace {

/// rad or m. Errors are thousandths; commands that need more would turn the wrist over to mend an angle of that size.
constexpr double kLargestCorrection = 0.5;

}  // namespace

InverseSolution command_reaching(const CorrectedRobot& robot, const Eigen::Isometry3d& goal, const Stop& start,
                                 const InverseOptions& options) {
  const std::string own_tool;
  const PoseFunction model = [&](const JointVector& commanded) {
    return robot.predict_with_jacobian(start.with_joints(commanded), own_tool);
  };
  const InverseSolution exact = inverse(model, goal, start.joints, options);
  const bool converged = exact.status == InverseStatus::converged;
  if (converged && (exact.q - start.joints).cwiseAbs().maxCoeff() <= kLargestCorrection) return exact;

  InverseSolution nearest = exact;
  nearest.q = damped_least_squares(model, goal, start.joints);
  const PoseError left = pose_error(robot.predict(start.with_joints(nearest.q), own_tool), goal);
  nearest.position_residual_m = left.head<3>().norm();
  nearest.orientation_residual_rad = left.tail<3>().norm();
  if (converged) nearest.status = InverseStatus::damped;
  return nearest;
}

}  // namespace demecal
