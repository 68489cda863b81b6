#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "calibration/joint_targets.hpp"
#include "data/data_set.hpp"
#include "decompositions/decompositions.hpp"
#include "effects/arm_state.hpp"
#include "kinematics/chain.hpp"
#include "kinematics/forward.hpp"
#include "kinematics/inverse.hpp"
#include "parameters/observation.hpp"
#include "prediction/corrected_robot.hpp"
#include "prediction/measurement.hpp"

namespace demecal::inline calibration {
namespace {

/// A laser tracker's, m, rad and m: exact data must not make the joints take up what no joint can.
constexpr RowScales kInstrument{2e-5, 5e-5, 2e-5};
constexpr double kSmallestShare = 0.01, kShareStep = 1.25;
constexpr int kMostNewtonSteps = 50;
constexpr double kSettledStep = 1e-10;  ///< of a step, in standard deviations

RowScales scales_with_share(const RowScales& residuals, double share) {
  RowScales scales{};
  for (std::size_t kind = 0; kind < kRowKinds; ++kind) {
    if (residuals[kind] > 0.0) scales[kind] = std::max(share * residuals[kind], kInstrument[kind]);
  }
  return scales;
}

/// The rows of a pose that are in use; derivatives by the joints' errors in units of their standard deviations.
struct JointRows {
  Eigen::VectorXd residual;
  Eigen::MatrixXd jacobian;
  std::vector<std::size_t> kinds;

  Eigen::VectorXd variances(const RowScales& scales) const {
    Eigen::VectorXd squares(residual.size());
    for (Eigen::Index row = 0; row < squares.size(); ++row)
      squares[row] = std::pow(scales[kinds[static_cast<std::size_t>(row)]], 2);
    return squares;
  }
  Cholesky covariance(const RowScales& scales) const {
    Eigen::MatrixXd sum = jacobian * jacobian.transpose();
    sum.diagonal() += variances(scales);
    return Cholesky(sum);
  }
};

JointRows rows_at(const DataSet& data, const MeasuredPose& pose, const CorrectedRobot& robot, const JointVector& joints,
                  const JointBelief& belief, const RowScales& scales) {
  const PoseAndJacobian predicted = robot.predict_with_jacobian(Stop(pose).with_joints(joints), pose.target);
  const Eigen::VectorXd residuals = residual(robot, predicted.pose, data, pose);
  const Eigen::MatrixXd jacobian = measurement_jacobian(robot, predicted.pose, data, pose) *
                                   by_drives(robot.chain, predicted.jacobian) * belief.deviation.asDiagonal();
  const RowCounts count = count_rows(pose);
  JointRows rows;
  std::vector<Eigen::Index> used;
  Eigen::Index row = 0;
  for (std::size_t kind = 0; kind < kRowKinds; ++kind) {
    for (int i = 0; i < count[kind]; ++i, ++row) {
      if (scales[kind] <= 0.0) continue;
      used.push_back(row);
      rows.kinds.push_back(kind);
    }
  }
  rows.residual = residuals(used);
  rows.jacobian = jacobian(used, Eigen::all);
  return rows;
}

/// Minus twice the logarithm of the rows' probability density.
double deviance(const JointRows& rows, const RowScales& scales) {
  const Cholesky covariance = rows.covariance(scales);
  return covariance.whitened(rows.residual).squaredNorm() + covariance.log_determinant();
}

/// Minus twice the logarithm of the density of `x`, standard deviations from the mean, given the rows.
double misfit(const JointRows& rows, const Eigen::VectorXd& x, const RowScales& scales) {
  return x.squaredNorm() + (rows.residual.array().square() / rows.variances(scales).array()).sum();
}

}  // namespace

Eigen::VectorXd JointBelief::mean_at(const JointVector& commanded) const {
  Eigen::VectorXd errors = Eigen::VectorXd::Zero(commanded.size());
  for (std::size_t joint = 0; joint < mean.size(); ++joint) {
    const auto j = static_cast<Eigen::Index>(joint);
    errors[j] = mean[joint](commanded[j]);
  }
  return errors;
}

RowScales measurement_scales(const DataSet& data, std::span<const std::size_t> poses, const CorrectedRobot& robot,
                             const JointBelief& belief, const RowScales& residuals) {
  std::vector<JointRows> rows_of_poses;
  for (const std::size_t index : poses) {
    const MeasuredPose& pose = data.poses[index];
    rows_of_poses.push_back(rows_at(data, pose, robot, pose.joints + belief.mean_at(pose.joints), belief, residuals));
  }
  RowScales best = residuals;
  double least = std::numeric_limits<double>::infinity();
  for (double share = 1.0; share >= kSmallestShare; share /= kShareStep) {
    const RowScales scales = scales_with_share(residuals, share);
    double sum = 0.0;
    for (const JointRows& rows : rows_of_poses) sum += deviance(rows, scales);
    if (sum >= least) continue;
    least = sum;
    best = scales;
  }
  return best;
}

std::optional<JointVector> most_probable_errors(const DataSet& data, const MeasuredPose& pose,
                                                const CorrectedRobot& robot, const JointBelief& belief,
                                                const RowScales& scales) {
  const Eigen::VectorXd mean = belief.mean_at(pose.joints);
  const auto errors = [&](const Eigen::VectorXd& x) { return JointVector(mean + belief.deviation.cwiseProduct(x)); };
  const auto rows_for = [&](const Eigen::VectorXd& x) {
    return rows_at(data, pose, robot, pose.joints + errors(x), belief, scales);
  };
  Eigen::VectorXd x = Eigen::VectorXd::Zero(mean.size());
  JointRows rows = rows_for(x);
  for (int step = 0; step < kMostNewtonSteps; ++step) {
    const Eigen::VectorXd next =
        rows.jacobian.transpose() * rows.covariance(scales).solve(rows.residual + rows.jacobian * x);
    const Eigen::VectorXd change = next - x;
    if (!change.allFinite()) return std::nullopt;
    if (change.norm() < kSettledStep) return errors(x);
    double fraction = 1.0;
    const double present = misfit(rows, x, scales);
    for (; fraction > 1e-4; fraction /= 2.0) {
      JointRows tried = rows_for(x + fraction * change);
      if (misfit(tried, x + fraction * change, scales) > present) continue;
      rows = std::move(tried);
      break;
    }
    if (fraction <= 1e-4) return errors(x);  // as near as digits allow
    x += fraction * change;
  }
  return x.allFinite() ? std::optional(errors(x)) : std::nullopt;
}

}  // namespace demecal::inline calibration
