// The poses of a fit, and their residual rows in units of what each kind of row scatters; and rows of what is known
// between contacts (lengths, parallel or square planes).
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "data/data_set.hpp"
#include "kinematics/chain.hpp"
#include "parameters/parameter_space.hpp"
#include "prediction/corrected_robot.hpp"
#include "prediction/measurement.hpp"

namespace demecal::inline parameters {

/// The kinds of rows: position (points measured or touched), orientation, distance, in the order they stand in.
inline constexpr std::size_t kPosition = 0, kOrientation = 1, kDistance = 2, kRowKinds = 3;

/// By which the deviations of a station's rows differ from those of all, per kind.
struct StationFactors {
  std::string station;  ///< as MeasuredPose has it
  std::array<double, kRowKinds> factors{};
};

/// Per kind: the standard deviation of its residuals (m, rad, m), 0 where a fit does not use it.
struct RowScales : std::array<double, kRowKinds> {
  std::vector<StationFactors> stations{};  ///< those that are not named scatter as all do

  /// One where the pose's station is not named.
  double factor(const MeasuredPose& pose, std::size_t kind) const;
  /// Of the pose's own rows.
  double of(const MeasuredPose& pose, std::size_t kind) const { return (*this)[kind] * factor(pose, kind); }
};
using RowCounts = std::array<int, kRowKinds>;

/// One pose of a fit. Corrections and what the effects depend on do not change during a fit: they are known beforehand.
struct Observation {
  std::size_t pose = 0;                 ///< in the data set
  JointVector corrected;                ///< joints after corrections, before effects
  std::vector<EffectMotion> motions{};  ///< of the robot's effects, per unit of their coefficients
};
std::vector<Observation> observe(const DataSet& data, std::span<const std::size_t> poses, const CorrectedRobot& robot);

/// Rows of each kind that a pose measured, and that all observations did.
RowCounts count_rows(const MeasuredPose& pose);
RowCounts count_rows(const DataSet& data, const std::vector<Observation>& observations);
/// How many of a pose's rows, and of all observations', are of kinds in use.
int rows_in_use(const MeasuredPose& pose, const RowScales& scales);
int rows_in_use(const DataSet& data, const std::vector<Observation>& observations, const RowScales& scales);

/// The rows of one pose in use: residual over scale, of contacts over the model's size too (ParameterSpace), and its
/// derivative (rows x parameters) by the changes. Kept and given again it is not reallocated for poses with equally
/// many rows.
struct ScaledRows {
  Eigen::VectorXd residual;
  Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor> jacobian;
  ToolMotion motion;
};

/// Measured minus predicted (m, rad, m) of all rows of one pose, in use or not.
Eigen::VectorXd unscaled_residual(const DataSet& data, const CorrectedRobot& robot, const Observation& observation);

/// Fills the residual alone.
void scaled_residual(const DataSet& data, const CorrectedRobot& robot, const Observation& observation,
                     const RowScales& scales, ScaledRows& rows);

/// Fills residual and derivative. Those of orientations are taken at a zero residual: the gradient of the sum of
/// squares is exact all the same, since a rotation vector does not turn itself.
void scaled_rows(const DataSet& data, const ParameterSpace& space, const ModelPoint& point,
                 const Observation& observation, const RowScales& scales, ScaledRows& rows);

/// Root mean square per kind of the unscaled residuals, 0 for kinds without rows.
RowScales root_mean_squares(const DataSet& data, const CorrectedRobot& robot,
                            const std::vector<Observation>& observations);

/// Orientations this far off the model's tool are of a target that is mounted otherwise.
inline constexpr double kMountedOtherwise_rad = 0.1;

/// Whether measured orientations are of a target that is mounted otherwise than the robot's tool: 0.1 rad off, rms.
/// They then tell nothing of the arm.
bool mounted_otherwise(const DataSet& data, const CorrectedRobot& robot, const std::vector<Observation>& observations);

/// Known minus placed, over what is known's own uncertainty: rows of unit variance. Derivative by the changes.
struct RelationRows {
  Eigen::VectorXd residual;
  Eigen::MatrixXd jacobian;  ///< rows x parameters
};

/// The rows of all relations between contacts whose places are free in `space`, both of one set. A relation that
/// several sets have counts as one all the same: their rows share its uncertainty.
RelationRows relation_rows(const DataSet& data, const ParameterSpace& space, const ModelPoint& point);

}  // namespace demecal::inline parameters
