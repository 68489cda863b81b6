#include "fitting/scatter.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <array>
#include <cmath>

#include "fitting/median.hpp"
#include "fitting/row_sums.hpp"

namespace demecal::inline fitting {
namespace {

constexpr double kLeastDeviation = 1e-9;
/// Of a normal distribution: the standard deviation over the median of absolute values.
constexpr double kMedianToDeviation = 1.4826;

/// Inverse of a symmetric matrix in the directions it does not send to nothing.
Eigen::MatrixXd pseudo_inverse(const Eigen::MatrixXd& symmetric) {
  constexpr double kSingular = 1e-14;
  if (symmetric.size() == 0) return symmetric;
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> eigen(symmetric);
  Eigen::VectorXd inverse = eigen.eigenvalues();
  const double least = kSingular * inverse.maxCoeff();
  for (double& value : inverse) value = value > least ? 1 / value : 0.0;
  return eigen.eigenvectors() * inverse.asDiagonal() * eigen.eigenvectors().transpose();
}

double huber_weight(double norm, int rows) {
  const double threshold = huber_threshold(rows);
  return norm > threshold ? threshold / norm : 1.0;
}

/// RowKindSums over the poses of a fit, of one kind of row: J^T J of z, squared residuals over scale, rows; by weight.
struct RowKindSums {
  Eigen::MatrixXd information;
  double squares = 0.0;
  double rows = 0.0;
};

std::array<RowKindSums, kRowKinds> sum_up(const LeastSquares& problem, const Eigen::VectorXd& change) {
  std::array<RowKindSums, kRowKinds> sums;
  std::vector<Information> information(kRowKinds, Information(problem.basis));
  const ModelPoint point = problem.space.at(change);
  ScaledRows rows;
  for (const Observation& observation : problem.observations) {
    scaled_rows(problem.data, problem.space, point, observation, problem.scales, rows);
    const auto used = static_cast<int>(rows.residual.size());
    if (used == 0) continue;
    const double weight = problem.robust ? huber_weight(rows.residual.norm(), used) : 1.0;
    const RowCounts count = count_rows(problem.data.poses[observation.pose]);
    Eigen::Index from = 0;
    for (std::size_t kind = 0; kind < kRowKinds; ++kind) {
      if (problem.scales[kind] <= 0) continue;
      const auto residuals = rows.residual.segment(from, count[kind]);
      information[kind].add(rows.jacobian.middleRows(from, count[kind]), residuals, weight);
      sums[kind].squares += weight * residuals.squaredNorm();
      sums[kind].rows += weight * count[kind];
      from += count[kind];
    }
  }
  for (std::size_t kind = 0; kind < kRowKinds; ++kind) sums[kind].information = information[kind].squares();
  return sums;
}

/// What the prior tells of z.
Eigen::MatrixXd prior_information(const LeastSquares& problem) {
  const Eigen::MatrixXd rows = problem.prior.precision.asDiagonal() * problem.basis;
  return rows.transpose() * rows;
}

std::vector<std::size_t> find_outliers(const LeastSquares& problem, const CorrectedRobot& robot,
                                       const RowScales& scales) {
  // At least the normal quantile that one of so many exceeds once in a hundred fits: P(Z > x) < exp(-x^2 / 2) / 2.
  const double quantile = std::sqrt(2.0 * std::log(50.0 * static_cast<double>(problem.observations.size())));
  std::vector<std::size_t> outliers;
  ScaledRows rows;
  for (const Observation& observation : problem.observations) {
    scaled_residual(problem.data, robot, observation, scales, rows);
    const auto used = static_cast<int>(rows.residual.size());
    if (used > 0 && rows.residual.norm() > norm_quantile(used, quantile)) outliers.push_back(observation.pose);
  }
  std::sort(outliers.begin(), outliers.end());
  return outliers;
}

}  // namespace

RowScales median_deviations(const DataSet& data, const CorrectedRobot& robot,
                            const std::vector<Observation>& observations) {
  std::array<std::vector<double>, kRowKinds> absolute;
  for (const Observation& observation : observations) {
    const Eigen::VectorXd all = unscaled_residual(data, robot, observation);
    const RowCounts count = count_rows(data.poses[observation.pose]);
    int row = 0;
    for (std::size_t kind = 0; kind < kRowKinds; ++kind) {
      for (int i = 0; i < count[kind]; ++i) absolute[kind].push_back(std::abs(all[row++]));
    }
  }
  RowScales deviation{};
  for (std::size_t kind = 0; kind < kRowKinds; ++kind) {
    if (!absolute[kind].empty())
      deviation[kind] = std::max(kLeastDeviation, kMedianToDeviation * median(absolute[kind]));
  }
  return deviation;
}

Scatter scatter_at(const LeastSquares& problem, const Eigen::VectorXd& change) {
  const auto sums = sum_up(problem, change);
  Eigen::MatrixXd information = prior_information(problem), rescaled = information;
  for (const RowKindSums& sum : sums) information += sum.information;
  const Eigen::MatrixXd inverse = pseudo_inverse(information);
  const CorrectedRobot robot = problem.space.at(change).robot;
  const RowScales medians = median_deviations(problem.data, robot, problem.observations);
  Scatter scatter;
  for (std::size_t kind = 0; kind < kRowKinds; ++kind) {
    if (problem.scales[kind] <= 0) continue;
    const double taken = inverse.cwiseProduct(sums[kind].information).sum();
    const double left = std::max(sums[kind].rows - taken, 1.0);
    scatter.deviation[kind] = std::max(kLeastDeviation, problem.scales[kind] * std::sqrt(sums[kind].squares / left));
    scatter.median_deviation[kind] = medians[kind] * std::sqrt((left + taken) / left);
    rescaled += std::pow(problem.scales[kind] / scatter.deviation[kind], 2) * sums[kind].information;
  }
  scatter.covariance = pseudo_inverse(rescaled);
  scatter.outliers = find_outliers(problem, robot, scatter.median_deviation);
  return scatter;
}

}  // namespace demecal::inline fitting
