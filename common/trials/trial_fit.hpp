// A quick fit of base, tools and links to measured points that a few wrong rows do not move, to try explanations with.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <cstddef>
#include <vector>

#include "kinematics/chain.hpp"

namespace demecal::inline trials {

/// One measured point of a trial.
struct TrialRow {
  JointVector joints;
  Eigen::Vector3d point_m;  ///< instrument's frame
  int target = 0;           ///< which of the trial's tools
  int station = 0;          ///< which of the trial's places of the instrument
  std::size_t pose = 0;     ///< in the data set
  JointVector sides{};      ///< of approach, as stated: -1, 0 or 1 of each joint; empty: not stated
  double payload_kg = 0.0, temperature_celsius = 0.0;  ///< as stated, otherwise 0
};

/// An arm and what was measured of it, as somebody supposes that they are.
struct Trial {
  Chain chain;
  std::vector<Eigen::Vector3d> tools_m;  ///< flange frame
  std::vector<TrialRow> rows;
  int stations = 1;

  /// The farthest that the nominal tool points come from the first axis' origin, at least 0.1.
  double reach_m() const;
  /// How often a pose (the same joints to the last digit) is measured, in the mean.
  double rows_per_pose() const;
};

struct TrialFit {
  Chain chain;                                      ///< with fitted links
  std::vector<Eigen::Isometry3d> sensor_from_base;  ///< one per station
  std::vector<Eigen::Vector3d> tools_m;
  /// Of all parameters, m and rad: six of each station, three of each tool, four of each link; those of the links
  /// are missing where they were not fitted. Empty before the first step.
  Eigen::MatrixXd covariance;
  std::vector<double> error_m;  ///< of each row
  double median_m = 0.0;        ///< of error_m; infinite without rows
  double deviation_m = 0.0;     ///< standard deviation of a coordinate, as the errors show it; see fit_base_and_tools
  double rows_per_pose = 1.0;   ///< of the trial
  double usual_m = 0.0;         ///< standard deviation that fitted links of an arm of this size usually leave
  double effective_parameters = 0.0;  ///< that the points determined, as a number: priors hold the others

  /// The covariance, m^2, of the tool point that this fit predicts for a row: wide where the rows it was fitted to say
  /// nothing about it.
  Eigen::Matrix3d prediction_covariance(const TrialRow& row) const;
  /// How far off a row is, in standard deviations of noise and prediction together.
  double deviations_off(const TrialRow& row) const;
  /// The covariance, m^2, of a tool point in the flange's frame.
  Eigen::Matrix3d tool_covariance(int tool) const;
  bool has_links() const;
};

/// Base and tools: closed-form registration of the nominal points (Horn 1987), weighted by 1 / error, then Gauss-Newton
/// steps with Tukey's weights. Their scale is the error at the rank (n + p / 3) / 2 of n rows, of which p parameters
/// can fit p / 3 exactly, so that half of the others count (Rousseeuw and Leroy 1987), over what three normals of unit
/// variance reach at that rank, times sqrt(n / (n - p / 3)).
TrialFit fit_base_and_tools(const Trial& trial);

/// Steps from the base and tools of `start`, in place of a registration.
TrialFit refit_base_and_tools(const Trial& trial, TrialFit start);

/// The fit of base and tools with the least median, of `placed` and of steps from orientations of the base all round,
/// each with the tools that suit it best: along a smooth path the nominal tool may lead to another minimum. Of trials
/// of one station.
TrialFit search_base_and_tools(const Trial& trial, const TrialFit& placed);

/// The same with every link parameter beside them, held near nominal by kLinkDeviation over the scale of the errors:
/// where nothing fits, links stay as they are; where all fits, they take what the points show. Goes on from `placed`,
/// a fit of base and tools.
TrialFit fit_arm(const Trial& trial, const TrialFit& placed);

/// The same by plain least squares: no row is left out, however far off.
TrialFit fit_arm_to_all(const Trial& trial, const TrialFit& placed);

/// A trial about a fit: error = jacobian * change of all parameters, which have `prior` as information.
struct LinearizedTrial {
  Eigen::MatrixXd jacobian;  ///< three rows each
  Eigen::VectorXd prior, error_m;
};

/// About a fit with links.
LinearizedTrial linearized(const Trial& trial, const TrialFit& fit);

/// The tool point of a row by a fit, instrument's frame.
Eigen::Vector3d predicted_point(const TrialFit& fit, const TrialRow& row);

/// The rigid motion that brings points (columns) to measured ones at least weighted squares (Horn 1987).
Eigen::Isometry3d weighted_registration(const Eigen::Matrix3Xd& from, const Eigen::Matrix3Xd& to,
                                        const Eigen::VectorXd& weights);

}  // namespace demecal::inline trials
