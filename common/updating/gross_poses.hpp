// Which of few new poses are gross errors by what a model found before and the other poses say.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <vector>

#include "updating/belief_sizes.hpp"

namespace demecal::inline updating {

/// What all other poses predict of each, all sizes being as they are.
struct LeftOut {
  double squares = 0.0;          ///< of the rows' errors
  std::vector<double> by_pose;   ///< the same
  std::vector<double> standard;  ///< root mean square per pose, in predicted deviations
};
LeftOut left_out(const Eigen::MatrixXd& covariance, const NewRows& rows, double noise);

/// The poses (of the data set, in its order) that are gross errors: others predict them far worse than usual. One gross
/// error among few poses is taken for noise or for a change of everything, so the worst is also judged by the sizes
/// that are likeliest without it, of six poses and more.
std::vector<std::size_t> gross_poses(const PriorModel& prior, const NewRows& rows, const BeliefSizes& sizes,
                                     JointSizes joints);

}  // namespace demecal::inline updating
