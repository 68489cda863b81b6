// Points where an arm puts them, beside those that were measured.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <cstddef>
#include <vector>

namespace demecal::inline trials {

inline constexpr double kLeastFall = 0.4;  ///< ratio of median errors that is far better
inline constexpr double kSmallestShift_m = 1e-4;
/// Deviations that fitted links usually leave, beyond which rows do not fit wherever they were measured from: 0.6 % of
/// the reach at the median.
inline constexpr double kMostOverUsual = 30.0;

/// Points of the arm in its base, and as they were measured.
struct PointPairs {
  std::vector<Eigen::Vector3d> arm, measured;
};

/// The motion that brings the arm's points [begin, end) to the measured ones, large errors counting less (L1).
Eigen::Isometry3d registration(const PointPairs& pairs, std::size_t begin, std::size_t end);

}  // namespace demecal::inline trials
