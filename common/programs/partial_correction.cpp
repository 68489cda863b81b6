#include "decompositions/decompositions.hpp"
#include "effects/arm_state.hpp"
#include "kinematics/inverse.hpp"
#include "prediction/corrected_robot.hpp"
#include "programs/target_correction.hpp"

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <memory>
#include <utility>

#include "kinematics/chain.hpp"
#include "kinematics/forward.hpp"

namespace demecal::inline programs {
namespace {

constexpr double kSure = 4.0;  ///< standard deviations

/// The largest share, up to 1, of `applied` with which the squared error |truth - share * applied|^2 stays below
/// |truth|^2 by kSure standard deviations, the truth being `correction` give or take `covariance`.
double safe_share(const Eigen::Vector3d& correction, const Eigen::Vector3d& applied,
                  const Eigen::Matrix3d& covariance) {
  const double square = applied.squaredNorm();
  if (square == 0.0) return 0.0;
  const double deviation = std::sqrt(std::max(0.0, applied.dot(covariance * applied)));
  return std::clamp(2.0 * (correction.dot(applied) - kSure * deviation) / square, 0.0, 1.0);
}

/// Along the principal axes: what to make of a correction, and how much that is expected to lower the squared error.
struct CorrectedAxes {
  Eigen::Vector3d along = Eigen::Vector3d::Zero();
  double gain = 0.0;
};

/// The best of all sets of axes along which the correction is above its deviation by so much that making it is nearer
/// to the truth on average than leaving it.
CorrectedAxes best_axes(const Eigen::Vector3d& along, const Eigen::Vector3d& variances) {
  constexpr int kSets = 8;
  CorrectedAxes best;
  for (int set = 1; set < kSets; ++set) {
    Eigen::Vector3d kept = along;
    for (int axis = 0; axis < 3; ++axis) {
      if (((set >> axis) & 1) == 0 || along[axis] * along[axis] <= 2.0 * variances[axis]) kept[axis] = 0.0;
    }
    kept *= safe_share(along, kept, variances.asDiagonal());
    const double gain = 2.0 * along.dot(kept) - kept.squaredNorm();
    if (gain > best.gain) best = {kept, gain};
  }
  return best;
}

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
JointVector kept_step(Jacobian jacobian, PoseError error, double length_m, int held) {
  jacobian.leftCols(held).setZero();
  jacobian.topRows<3>() /= length_m;
  error.head<3>() /= length_m;
  const SingularSystem svd = singular_system(jacobian, Eigen::ComputeThinU | Eigen::ComputeThinV);
  Eigen::VectorXd along = svd.u.transpose() * error;
  for (Eigen::Index i = 0; i < along.size(); ++i) {
    const double value = svd.values[i];
    along[i] = value > kLost ? along[i] / value : 0.0;
  }
  JointVector step = svd.v * along;
  step.head(held).setZero();
  return step;
}

/// Whether joints move by no more than the correction (missing at the start) is worth.
bool is_near(const JointVector& joints, const Stop& start, const PoseError& correction) {
  const double moved = (joints - start.joints).cwiseAbs().maxCoeff();
  return moved <= kMostGain * in_angles(correction).norm() + kFreely;
}

/// Newton's steps from the start in the directions that are not lost.
JointVector kept_command(const CorrectedRobot& robot, const Eigen::Isometry3d& goal, const Stop& start, double length_m,
                         int held) {
  constexpr int kSteps = 12;
  constexpr double kSettled = 1e-10;
  JointVector joints = start.joints;
  for (int step = 0; step < kSteps; ++step) {
    const PoseAndJacobian at = robot.predict_with_jacobian(start.with_joints(joints), "");
    const JointVector change = kept_step(at.jacobian, pose_error(at.pose, goal), length_m, held);
    if (!change.allFinite()) break;
    joints += change;
    if (change.norm() < kSettled) break;
  }
  return joints;
}

}  // namespace

DeterminedPart determined_part(const Eigen::Vector3d& correction, const Eigen::Matrix3d& covariance,
                               double worth_saying) {
  constexpr double kMostlyLeft = 0.5;
  const auto eigen = eigen_system_of_three(covariance);
  const Eigen::Matrix3d& axes = eigen.vectors;
  const Eigen::Vector3d along = axes.transpose() * correction;
  const Eigen::Vector3d variances = eigen.values.cwiseMax(0.0);
  const Eigen::Vector3d kept = best_axes(along, variances).along;
  DeterminedPart part;
  part.applied = kept == along ? correction : Eigen::Vector3d(axes * kept);
  for (int axis = 0; axis < 3; ++axis) {
    const double deviation = std::sqrt(variances[axis]);
    const bool left = std::abs(kept[axis]) <= kMostlyLeft * std::abs(along[axis]);
    if (!left || deviation <= std::max(worth_saying, part.deviation)) continue;
    part.omitted = axes.col(axis);
    part.deviation = deviation;
  }
  return part;
}

InverseSolution nearby_command(const CorrectedRobot& robot, const Eigen::Isometry3d& goal, const Stop& start,
                               int held) {
  constexpr double kPositionFirst_m = 0.01;
  InverseSolution solution = command_reaching(robot, goal, start, {.held = held});
  const PoseError correction = pose_error(robot.predict(start, ""), goal);
  const bool exact = solution.status == InverseStatus::converged && is_near(solution.q, start, correction);
  if (start.joints.size() - held < 6 || exact) return solution;
  solution.q = kept_command(robot, goal, start, kPositionFirst_m, held);
  if (!is_near(solution.q, start, correction)) solution.q = kept_command(robot, goal, start, kLength_m, held);
  const PoseError left = pose_error(robot.predict(start.with_joints(solution.q), ""), goal);
  solution.position_residual_m = left.head<3>().norm();
  solution.orientation_residual_rad = left.tail<3>().norm();
  const bool all = solution.position_residual_m < kLeft_m && solution.orientation_residual_rad < kLeft_rad;
  solution.status = all ? InverseStatus::converged : InverseStatus::damped;
  return solution;
}

}  // namespace demecal::inline programs
