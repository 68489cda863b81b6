// How a prediction meets what was measured: the residual rows of a pose, whichever quantities its instrument gives, and
// the figures that users judge by.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <cstddef>
#include <span>
#include <vector>

#include "data/contacts.hpp"
#include "data/data_set.hpp"
#include "prediction/contact_place.hpp"
#include "prediction/corrected_robot.hpp"

namespace demecal::inline prediction {

// Distances are understood as lengths from the known anchors, one each in their order: a data set whose anchors are
// unknown has no prediction here, and its caller refuses it.

/// What a pose measured: 3 rows per position (m), as many as its kind has per contact (m), 3 per orientation (rad), 1
/// per distance (m), in this order.
struct MeasurementRows {
  int position = 0;
  int contact = 0;
  int orientation = 0;
  int distances = 0;

  /// Of points in space, whoever says where they are: they scatter alike.
  int points() const { return position + contact; }
  int total() const { return points() + orientation + distances; }
};
MeasurementRows rows_of(const MeasuredPose& pose);

/// Where the first station would have measured the pose's point, which must be measured; its orientation likewise.
Eigen::Vector3d measured_point(const CorrectedRobot& robot, const MeasuredPose& pose);
Eigen::Matrix3d measured_orientation(const CorrectedRobot& robot, const MeasuredPose& pose);

/// How a pose touches its contact, where the robot has its tool.
Touch touch_of(const CorrectedRobot& robot, const MeasuredPose& pose);

/// Measured minus predicted, rows as above, those of positions multiplied by the pose's whitening, of contacts by its
/// weight; the orientation part
/// is the rotation vector from predicted to measured. A contact that `robot` has no place for says nothing: its rows
/// are zero.
Eigen::VectorXd residual(const CorrectedRobot& robot, const DataSet& data, const MeasuredPose& pose);

/// The same where the tool's pose is already predicted; of `robot` only the contacts' places count.
Eigen::VectorXd residual(const CorrectedRobot& robot, const Eigen::Isometry3d& predicted, const DataSet& data,
                         const MeasuredPose& pose);

/// The matrix (rows x 6; those of positions whitened as residuals are) that maps a small motion of the tool point
/// (linear m, angular rad, measurements' frame) to the change of the measured quantities at the predicted pose. A
/// distance's row is zero at its anchor, where it has no derivative.
Eigen::Matrix<double, Eigen::Dynamic, 6> measurement_jacobian(const CorrectedRobot& robot,
                                                              const Eigen::Isometry3d& predicted, const DataSet& data,
                                                              const MeasuredPose& pose);

/// `robot` with every group of contacts among `poses` placed where its own poses have it on average (of a plane, sphere
/// or line: by least squares).
CorrectedRobot with_own_contacts(CorrectedRobot robot, const DataSet& data, std::span<const std::size_t> poses);
/// The same of all poses.
CorrectedRobot with_own_contacts(CorrectedRobot robot, const DataSet& data);

/// The errors of the poses that have one, and NaN for the others: the distance between predicted and measured tool
/// point, m; of a pose that touches something, from where all poses of its group have the contact on average; where
/// only distances were measured, the root mean square of their errors.
std::vector<double> tool_errors_m(const CorrectedRobot& robot, const DataSet& data, std::span<const std::size_t> poses);
/// The same where the tools' poses are already predicted, one for each of `poses`; contacts' means are over these.
std::vector<double> tool_errors_m(const CorrectedRobot& robot, const std::vector<Eigen::Isometry3d>& predicted,
                                  const DataSet& data, std::span<const std::size_t> poses);

/// Of one pose, a contact taken to be where `robot` has it (NaN where it has no place).
double tool_error_m(const CorrectedRobot& robot, const DataSet& data, const MeasuredPose& pose);

/// The same where the tool's pose is already predicted.
double tool_error_m(const CorrectedRobot& robot, const Eigen::Isometry3d& predicted, const DataSet& data,
                    const MeasuredPose& pose);

/// Whether rows of a pose's position or contact tell a tool error.
bool measures_point(const MeasuredPose& pose);

/// A known distance as the poses of one set have it.
struct LengthError {
  const KnownDistance* known = nullptr;
  PoseSet set = PoseSet::calibration;
  double error_m = 0.0;                             ///< between the two contacts' places, minus the known length
  Eigen::Vector3d along = Eigen::Vector3d::Zero();  ///< unit; how it grows as the first place moves
};
/// Of every known distance, in every set that touches both its ends; contacts where `robot`'s own poses have them.
std::vector<LengthError> length_errors(const CorrectedRobot& robot, const DataSet& data);

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
