// A quick fit of base, tools and links to measured points that a few wrong rows do not move, to try explanations with.
#pragma once

#include <Eigen/Geometry>
#include <vector>

#include "kinematics/chain.hpp"

namespace demecal {

/// One measured point of a trial.
struct TrialRow {
  JointVector joints;
  Eigen::Vector3d point_m;  ///< instrument's frame
  int target = 0;           ///< which of the trial's tools
  int station = 0;          ///< which of the trial's places of the instrument
  std::size_t pose = 0;     ///< in the data set
};

/// An arm and what was measured of it, as somebody supposes that they are.
struct Trial {
  Chain chain;
  std::vector<Eigen::Vector3d> tools_m;  ///< flange frame
  std::vector<TrialRow> rows;
  int stations = 1;
};

struct TrialFit {
  Chain chain;                                      ///< with fitted links
  std::vector<Eigen::Isometry3d> sensor_from_base;  ///< one per station
  std::vector<Eigen::Vector3d> tools_m;
  Eigen::MatrixXd tool_covariance;  ///< 3 T x 3 T, m^2; empty where links were not fitted
  std::vector<double> error_m;      ///< of each row
  double median_m = 0.0;            ///< of error_m; infinite without rows
  double largest_change = 0.0;      ///< of a link parameter, over its standard deviation as made

  /// Standard deviation of a coordinate that the median error stands for.
  double deviation_m() const;
};

/// How far makers' figures are from the truth, as a standard deviation: that of FitOptions.
inline constexpr double kLinkDeviation_m = 5e-3, kLinkDeviation_rad = 17.5e-3;

/// Base and tools: closed-form registration of the nominal points (Horn 1987), weighted by 1 / error, then Gauss-Newton
/// steps with Tukey's weights on a scale taken from the median error.
TrialFit fit_base_and_tools(const Trial& trial);

/// The same with every link parameter beside them, held near nominal by kLinkDeviation over the scale of the errors:
/// where nothing fits, links stay as they are; where all fits, they take what the points show. Goes on from `placed`,
/// a fit of base and tools.
TrialFit fit_arm(const Trial& trial, const TrialFit& placed);

/// The tool point of a row by a fit, instrument's frame.
Eigen::Vector3d predicted_point(const TrialFit& fit, const TrialRow& row);

/// The rigid motion that brings points (columns) to measured ones at least weighted squares (Horn 1987).
Eigen::Isometry3d weighted_registration(const Eigen::Matrix3Xd& from, const Eigen::Matrix3Xd& to,
                                        const Eigen::VectorXd& weights);

/// About `count` of 0 .. `size` - 1 (all where there are no more), spread evenly over them, ascending.
std::vector<std::size_t> spread_indices(std::size_t size, std::size_t count);

}  // namespace demecal
