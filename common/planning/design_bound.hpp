// How good a plan could be at best: a bound of the error that any poses of a space leave, as many as are planned.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <vector>

#include "planning/cell.hpp"
#include "planning/information.hpp"
#include "random/random_stream.hpp"

namespace demecal::inline planning {

/// Below this expected squared error (m^2, mean over the workspace) no `count` poses of the space get, whichever they
/// are and however often each is measured. It is that of a design with weights in place of whole numbers (made by the
/// multiplicative algorithm of Silvey, Titterington and Torsney, 1978), lowered by what the steepest pose may still
/// gain on it (the equivalence theorem, after Kiefer, 1974): the inverse of the error is concave in the information.
/// The steepest pose is searched for from the best of `poses` on; the bound is as sure as that search. `known` and
/// `weight`: as of PosteriorCovariance; `poses`: feasible ones, where the design begins.
double least_square_m2(const InformationModel& model, const FeasibleSpace& space, std::vector<PlannedPose> poses,
                       const Eigen::MatrixXd& known, const Eigen::MatrixXd& weight, std::size_t count,
                       RandomStream random);

}  // namespace demecal::inline planning
