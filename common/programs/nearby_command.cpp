#include "programs/nearby_command.hpp"

#include <Eigen/SVD>
#include <algorithm>

namespace demecal {
namespace {

constexpr double kLength_m = 0.3;        ///< that scales positions to angles
constexpr double kMostGain = 8.0;        ///< joint motion, rad or m, over the correction
constexpr double kFreely = 2e-4;         ///< rad or m that a joint may always move
constexpr double kLost = 1 / kMostGain;  ///< singular value below which a direction is lost
constexpr double kLeft_m = 5e-6, kLeft_rad = 5e-5;

PoseError in_angles(PoseError error) {
  error.head<3>() /= kLength_m;
  return error;
}

/// The step of least norm in the directions that the arm has not lost.
JointVector kept_step(Jacobian jacobian, const PoseError& error) {
  jacobian.topRows<3>() /= kLength_m;
  const Eigen::JacobiSVD<Eigen::MatrixXd> svd(jacobian, Eigen::ComputeThinU | Eigen::ComputeThinV);
  Eigen::VectorXd along = svd.matrixU().transpose() * in_angles(error);
  for (Eigen::Index i = 0; i < along.size(); ++i) {
    const double value = svd.singularValues()[i];
    along[i] = value > kLost ? along[i] / value : 0.0;
  }
  return svd.matrixV() * along;
}

bool exact_and_near(const InverseSolution& solution, const Stop& start, const PoseError& correction) {
  const double moved = (solution.q - start.joints).cwiseAbs().maxCoeff();
  return solution.status == InverseStatus::converged && moved <= kMostGain * in_angles(correction).norm() + kFreely;
}

}  // namespace

InverseSolution nearby_command(const CorrectedRobot& robot, const Eigen::Isometry3d& goal, const Stop& start) {
  constexpr int kSteps = 12;
  constexpr double kSettled = 1e-10;
  InverseSolution solution = command_reaching(robot, goal, start);
  const auto missing = [&](const PoseAndJacobian& at) { return pose_error(at.pose, goal); };
  PoseAndJacobian at = robot.predict_with_jacobian(start, "");
  if (start.joints.size() < 6 || exact_and_near(solution, start, missing(at))) return solution;
  solution.q = start.joints;
  for (int step = 0; step < kSteps; ++step) {
    const JointVector change = kept_step(at.jacobian, missing(at));
    if (!change.allFinite()) break;
    solution.q += change;
    at = robot.predict_with_jacobian(start.with_joints(solution.q), "");
    if (change.norm() < kSettled) break;
  }
  const PoseError left = missing(at);
  solution.position_residual_m = left.head<3>().norm();
  solution.orientation_residual_rad = left.tail<3>().norm();
  const bool all = solution.position_residual_m < kLeft_m && solution.orientation_residual_rad < kLeft_rad;
  solution.status = all ? InverseStatus::converged : InverseStatus::damped;
  return solution;
}

}  // namespace demecal
