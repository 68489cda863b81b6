// How much of a correction is made: no more than is surely known, and no large joint motions near singular joints.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <optional>

#include "effects/arm_state.hpp"
#include "kinematics/inverse.hpp"
#include "prediction/corrected_robot.hpp"

namespace demecal::inline programs {

/// A correction of position (m) or of orientation (rad), as far as it should be made.
struct DeterminedPart {
  Eigen::Vector3d applied = Eigen::Vector3d::Zero();
  Eigen::Vector3d omitted =
      Eigen::Vector3d::Zero();  ///< direction (unit norm) left as programmed; 0: none worth saying
  double deviation = 0.0;       ///< standard deviation of the correction along `omitted`
};

/// Of `correction`, whose error has this covariance, along the covariance's principal axes. An axis may be corrected
/// where the correction's square is above twice its variance: below, leaving it is nearer to the truth on average. Of
/// all sets of such axes that one is corrected which lowers the squared error most, scaled down as far as needed for
/// the error to be no larger than before by four standard deviations, in the normal approximation. Directions in which
/// less than half is corrected, and whose deviation is above `worth_saying`, are said: the least known of them.
DeterminedPart determined_part(const Eigen::Vector3d& correction, const Eigen::Matrix3d& covariance,
                               double worth_saying);

/// As command_reaching(), but joints stay within a few times the correction itself (position over 0.3 m, and angle): in
/// directions that the arm has nearly lost the correction is left, of orientation rather than of position, and the
/// status is `damped` where that leaves more than 5 um or 0.05 mrad.
InverseSolution nearby_command(const CorrectedRobot& robot, const Eigen::Isometry3d& goal, const Stop& start);

}  // namespace demecal::inline programs
