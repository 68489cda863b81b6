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

/// Along the principal axes: what to make of a correction, and how much that is expected to lower the squared error.
struct Choice {
  Eigen::Vector3d along = Eigen::Vector3d::Zero();
  double gain = 0.0;
};

/// The best of all sets of axes along which the correction is above its deviation by so much that making it is nearer
/// to the truth on average than leaving it.
Choice best_choice(const Eigen::Vector3d& along, const Eigen::Vector3d& variances) {
  constexpr int kSets = 8;
  Choice best;
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

}  // namespace

DeterminedPart determined_part(const Eigen::Vector3d& correction, const Eigen::Matrix3d& covariance,
                               double worth_saying) {
  constexpr double kMostlyLeft = 0.5;
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> eigen(covariance);
  const Eigen::Matrix3d& axes = eigen.eigenvectors();
  const Eigen::Vector3d along = axes.transpose() * correction;
  const Eigen::Vector3d variances = eigen.eigenvalues().cwiseMax(0.0);
  const Eigen::Vector3d kept = best_choice(along, variances).along;
  DeterminedPart part;
  part.applied = kept == along ? correction : Eigen::Vector3d(axes * kept);
  for (int axis = 0; axis < 3; ++axis) {
    const double deviation = std::sqrt(variances[axis]);
    const bool left = std::abs(kept[axis]) <= kMostlyLeft * std::abs(along[axis]);
    if (!left || deviation <= std::max(worth_saying, part.deviation)) continue;
    part.left = axes.col(axis);
    part.deviation = deviation;
  }
  return part;
}

}  // namespace demecal
