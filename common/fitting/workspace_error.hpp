// How far the tool of a fitted model is really off, over all the places its joints were measured at.
#pragma once

#include <Eigen/Core>
#include <span>
#include <vector>

#include "expression/bound.hpp"
#include "fitting/posterior.hpp"
#include "prediction/corrected_robot.hpp"
#include "random/random_stream.hpp"

namespace demecal::inline fitting {

/// Leaves of every column what no shift and turn of the whole arm does as well, by least squares over all points.
/// `rows`: how each of `points_m` moves, 3 x columns.
void leave_out_motion_as_a_whole(const std::vector<Eigen::Vector3d>& points_m, std::vector<Eigen::MatrixXd>& rows);

struct WorkspaceError {
  double rms_m = 0.0, p95_m = 0.0;
};

/// What `posterior` and the interval's model error lead one to expect of the robot's own tool, joints anywhere in
/// `measured` and approached from either side; measurement noise is not in it. Where the poses did not tell where the
/// arm stands (`placed` is false), once the arm as a whole is shifted and turned to fit best.
WorkspaceError workspace_error(const Posterior& posterior, const PredictionInterval& interval,
                               const CorrectedRobot& robot, std::span<const Interval> measured, bool placed,
                               RandomStream random);

}  // namespace demecal::inline fitting
