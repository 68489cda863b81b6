// How measured points err, point by point in the order of measuring: m, in the instrument's frame.
#pragma once

#include <Eigen/Core>
#include <span>
#include <vector>

#include "random/random_stream.hpp"

namespace demecal::bench {

using Offsets = std::vector<Eigen::Vector3d>;

/// Independent normal errors with the standard deviation `deviation_m` on each axis.
Offsets white_noise(std::size_t points, double deviation_m, RandomStream& random);

/// On each axis an autoregression of first order, stationary from its first point on, with the standard deviation
/// `deviation_m`: neighbours in order correlate by `correlation`, in (-1, 1).
Offsets correlated_noise(std::size_t points, double correlation, double deviation_m, RandomStream& random);

/// Student's t with 3 degrees of freedom on each axis, scaled to the standard deviation `deviation_m`.
Offsets student_noise(std::size_t points, double deviation_m, RandomStream& random);

/// Normal errors on each axis that grow with the distance of the point from the instrument, the frame's origin:
/// `fixed_m` + `per_metre` times the distance.
Offsets tracker_noise(const Offsets& seen_m, double fixed_m, double per_metre, RandomStream& random);

/// A drift that ends (after infinitely many points) at `end_m`, its rest falling to 1/e within `points_to_e` points.
Offsets settling_drift(std::size_t points, const Eigen::Vector3d& end_m, double points_to_e);

/// A steady drift from nothing at the first point to `end_m` at the last.
Offsets steady_drift(std::size_t points, const Eigen::Vector3d& end_m);

/// Errors in random directions, between `least_m` and `most_m` with equal chances for every decade, at a share of the
/// points (rounded) chosen at random; zero elsewhere.
Offsets gross_errors(std::size_t points, double share, double least_m, double most_m, RandomStream& random);

/// A direction, uniform over the sphere.
Eigen::Vector3d random_direction(RandomStream& random);

void add_to(Offsets& sum, const Offsets& more);

}  // namespace demecal::bench
