// Planned poses moved a little, one after another, wherever that lets them tell more: what no list of candidates holds.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "planning/cell.hpp"
#include "planning/information.hpp"
#include "random/random_stream.hpp"

namespace demecal::inline planning {

/// Poses, and the covariance that measuring them leaves of the model's numbers, in units of belief.
struct RefinedPoses {
  std::vector<PlannedPose> poses;
  Eigen::MatrixXd covariance;
};

/// `poses` after rounds in which each is replaced by the best of feasible poses near it, or with one joint anywhere
/// (coordinate exchange after Meyer and Nachtsheim, 1995), where that lowers the expected squared error: the product of
/// `weight` with the covariance. `known`: information already there. Never worse than what it begins with.
RefinedPoses refined(const InformationModel& model, const FeasibleSpace& space, std::vector<PlannedPose> poses,
                     const Eigen::MatrixXd& known, const Eigen::MatrixXd& weight, RandomStream random);

}  // namespace demecal::inline planning
