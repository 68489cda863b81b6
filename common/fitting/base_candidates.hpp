// Where a base might stand in the instrument's frame: guesses good enough to be refined.
#pragma once

#include <Eigen/Geometry>
#include <vector>

#include "fitting/observation.hpp"

namespace demecal {

/// Poses of the base in the measurements' frame that the observations suggest. Where positions were measured: the
/// closed-form registration of `robot`'s points to the measured ones (Horn 1987, Umeyama 1991), then `count`
/// orientations spread over all, the middles of the points brought together. Where only distances were: the `count`
/// best of these orientations set down in 15 places around the anchors. Otherwise: the orientations alone.
std::vector<Eigen::Isometry3d> base_candidates(const DataSet& data, const std::vector<Observation>& observations,
                                               const CorrectedRobot& robot, int count);

/// The `index`-th of `count` rotations spread evenly over all (super-Fibonacci spiral, Alexa 2022).
Eigen::Matrix3d spread_rotation(int index, int count);

/// The rotation nearest to `matrix` (Frobenius).
Eigen::Matrix3d nearest_rotation(const Eigen::Matrix3d& matrix);

}  // namespace demecal
