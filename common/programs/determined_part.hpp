// How much of a correction is worth making, given how surely it is known.
#pragma once

#include <Eigen/Core>
#include <optional>

namespace demecal {

/// A correction of position (m) or of orientation (rad), as far as it should be made.
struct DeterminedPart {
  Eigen::Vector3d applied = Eigen::Vector3d::Zero();
  Eigen::Vector3d left = Eigen::Vector3d::Zero();  ///< direction (unit norm) left as programmed; 0: none worth saying
  double deviation = 0.0;                          ///< standard deviation of the correction along `left`
};

/// Of `correction`, whose error has this covariance, along the covariance's principal axes. An axis may be corrected
/// where the correction's square is above twice its variance: below, leaving it is nearer to the truth on average. Of
/// all sets of such axes that one is corrected which lowers the squared error most, scaled down as far as needed for
/// the error to be no larger than before by four standard deviations, in the normal approximation. Directions in which
/// less than half is corrected, and whose deviation is above `worth_saying`, are said: the least known of them.
DeterminedPart determined_part(const Eigen::Vector3d& correction, const Eigen::Matrix3d& covariance,
                               double worth_saying);

}  // namespace demecal
