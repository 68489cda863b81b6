#include "programs/nearby_command.hpp"

#include <Eigen/SVD>
#include <algorithm>

namespace demecal {
namespace {

constexpr double kLength_m = 0.3;  ///< that scales positions to angles
constexpr double kMostGain = 3.0;  ///< joint motion, rad or m, over the correction
constexpr double kFreely = 2e-4;   ///< rad or m that a joint may always move
constexpr double kLost = 0.125;    ///< singular value below which a direction is lost
constexpr double kLeft_m = 5e-6, kLeft_rad = 5e-5;

PoseError in_angles(PoseError error) {
  error.head<3>() /= kLength_m;
  return error;
}

/// The step of least norm in the directions that the arm has not lost, positions counting over `length_m`.
JointVector kept_step(Jacobian jacobian, PoseError error, double length_m) {
  jacobian.topRows<3>() /= length_m;
  error.head<3>() /= length_m;
  const Eigen::JacobiSVD<Eigen::MatrixXd> svd(jacobian, Eigen::ComputeThinU | Eigen::ComputeThinV);
  Eigen::VectorXd along = svd.matrixU().transpose() * error;
  for (Eigen::Index i = 0; i < along.size(); ++i) {
    const double value = svd.singularValues()[i];
    along[i] = value > kLost ? along[i] / value : 0.0;
  }
  return svd.matrixV() * along;
}

/// Whether joints move by no more than the correction (missing at the start) is worth.
bool is_near(const JointVector& joints, const Stop& start, const PoseError& correction) {
  const double moved = (joints - start.joints).cwiseAbs().maxCoeff();
  return moved <= kMostGain * in_angles(correction).norm() + kFreely;
}

/// Newton's steps from the start in the directions that are not lost.
JointVector kept_command(const CorrectedRobot& robot, const Eigen::Isometry3d& goal, const Stop& start,
                         double length_m) {
  constexpr int kSteps = 12;
  constexpr double kSettled = 1e-10;
  JointVector joints = start.joints;
  for (int step = 0; step < kSteps; ++step) {
    const PoseAndJacobian at = robot.predict_with_jacobian(start.with_joints(joints), "");
    const JointVector change = kept_step(at.jacobian, pose_error(at.pose, goal), length_m);
    if (!change.allFinite()) break;
    joints += change;
    if (change.norm() < kSettled) break;
  }
  return joints;
}

}  // namespace

InverseSolution nearby_command(const CorrectedRobot& robot, const Eigen::Isometry3d& goal, const Stop& start) {
  constexpr double kPositionFirst_m = 0.01;
  InverseSolution solution = command_reaching(robot, goal, start);
  const PoseError correction = pose_error(robot.predict(start, ""), goal);
  const bool exact = solution.status == InverseStatus::converged && is_near(solution.q, start, correction);
  if (start.joints.size() < 6 || exact) return solution;
  solution.q = kept_command(robot, goal, start, kPositionFirst_m);
  if (!is_near(solution.q, start, correction)) solution.q = kept_command(robot, goal, start, kLength_m);
  const PoseError left = pose_error(robot.predict(start.with_joints(solution.q), ""), goal);
  solution.position_residual_m = left.head<3>().norm();
  solution.orientation_residual_rad = left.tail<3>().norm();
  const bool all = solution.position_residual_m < kLeft_m && solution.orientation_residual_rad < kLeft_rad;
  solution.status = all ? InverseStatus::converged : InverseStatus::damped;
  return solution;
}

}  // namespace demecal
