#include "programs/determined_part.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

namespace demecal {
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

}  // namespace

DeterminedPart determined_part(const Eigen::Vector3d& correction, const Eigen::Matrix3d& covariance,
                               double worth_saying) {
  constexpr double kMostlyLeft = 0.5;
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> eigen(covariance);
  const Eigen::Matrix3d& axes = eigen.eigenvectors();
  const Eigen::Vector3d along = axes.transpose() * correction;
  Eigen::Vector3d kept = along;
  for (int axis = 0; axis < 3; ++axis) {
    if (along[axis] * along[axis] <= 2.0 * std::max(0.0, eigen.eigenvalues()[axis])) kept[axis] = 0.0;
  }
  DeterminedPart part;
  const double share = safe_share(correction, axes * kept, covariance);
  part.applied = share * (axes * kept);
  for (int axis = 0; axis < 3; ++axis) {
    const double deviation = std::sqrt(std::max(0.0, eigen.eigenvalues()[axis]));
    const bool left = kept[axis] == 0.0 || share < kMostlyLeft;
    if (!left || deviation <= std::max(worth_saying, part.deviation)) continue;
    part.left = axes.col(axis);
    part.deviation = deviation;
  }
  return part;
}

}  // namespace demecal
