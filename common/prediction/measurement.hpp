// How a prediction meets what was measured: the residual rows of a pose, whichever quantities its instrument gives, and
// the figures that users judge by.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <cstddef>
#include <span>
#include <vector>

#include "data/data_set.hpp"
#include "prediction/corrected_robot.hpp"

namespace demecal::inline prediction {

// Distances are understood as lengths from the known anchors, one each in their order: a data set whose anchors are
// unknown has no prediction here, and its caller refuses it.

/// What a pose measured: 3 rows per position (m), 3 per orientation (rad), 1 per distance (m), in this order.
struct MeasurementRows {
  int position = 0;
  int orientation = 0;
  int distances = 0;

  int total() const { return position + orientation + distances; }
};
MeasurementRows rows_of(const MeasuredPose& pose);

/// Measured minus predicted, rows as above; the orientation part is the rotation vector from predicted to measured.
Eigen::VectorXd residual(const CorrectedRobot& robot, const DataSet& data, const MeasuredPose& pose);

/// The same where the tool's pose is already predicted.
Eigen::VectorXd residual(const Eigen::Isometry3d& predicted, const DataSet& data, const MeasuredPose& pose);

/// The matrix (rows x 6) that maps a small motion of the tool point (linear m, angular rad, measurements' frame) to the
/// change of the measured quantities at the predicted pose. A distance's row is zero at its anchor, where it has no
/// derivative.
Eigen::Matrix<double, Eigen::Dynamic, 6> measurement_jacobian(const Eigen::Isometry3d& predicted, const DataSet& data,
                                                              const MeasuredPose& pose);

/// The distance between predicted and measured tool point, m; where only distances were measured, the root mean square
/// of their errors; NaN where neither was.
double tool_error_m(const CorrectedRobot& robot, const DataSet& data, const MeasuredPose& pose);

/// The same where the tool's pose is already predicted.
double tool_error_m(const Eigen::Isometry3d& predicted, const DataSet& data, const MeasuredPose& pose);

/// The four figures users judge by, in mm, over the tool errors of the named poses; all NaN where there are none.
/// The 95th percentile is interpolated linearly between order statistics: that of rank 1 + 0.95 (n - 1). Poses that
/// measured orientation only have no tool error and do not count.
struct ErrorFigures {
  double mean_mm, rms_mm, p95_mm, max_mm;
};
ErrorFigures error_figures(const CorrectedRobot& robot, const DataSet& data, std::span<const std::size_t> poses);

/// Beyond this a tool error is gross: three times what nine of ten of these keep within (normal noise exceeds 2.3 times
/// that less than once in a million). NaN does not count; infinite where nothing else is there.
double gross_error_limit(std::vector<double> errors);

/// As error_figures() of poses, of these tool errors, mm (none NaN); all NaN where there are none.
ErrorFigures error_figures(std::vector<double> errors_mm);

}  // namespace demecal::inline prediction
