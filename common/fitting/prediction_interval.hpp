// How far predictions lie from what is measured: radii that hold 95 % of a model's errors, pose by pose.
#pragma once

#include <cstddef>
#include <span>

#include "data/data_set.hpp"
#include "fitting/posterior.hpp"

namespace demecal {

/// What a radius needs beside the model's posterior. Deviations are standard deviations per axis, m.
struct PredictionInterval {
  double quantile = 0.0;          ///< of scores |error| / deviation; radii are so many deviations
  double noise_m = 0.0;           ///< of measured positions: of repeats or, without any, of the fit's residuals
  double distance_noise_m = 0.0;  ///< the same of measured distances
  double model_error_m = 0.0;     ///< what the poses behind the quantile show beyond noise and posterior
  std::size_t poses = 0;          ///< behind the quantile, repeats of one pose counted once
  std::size_t gross_errors = 0;   ///< poses left out of it as far out
  bool fitted = false;            ///< the poses behind it are those of the fit: no others were there
};

/// What intervals hold.
inline constexpr double kIntervalShare = 0.95;

/// The quantile of split conformal prediction (Lei et al. 2018): a new score, exchangeable with these, is at most that
/// with probability `share`. `groups`: of each score; scores of one group (repeats of a pose, a block of neighbours in
/// time) share one vote between them. Infinite where there are too few groups to tell: fewer than 19 for 0.95.
double conformal_quantile(std::span<const double> scores, std::span<const std::size_t> groups, double share);

/// The same for any number of groups where every score is the norm of `rows` independent normal errors (times one
/// unknown factor): by Fisher's F of `rows` and rows x groups degrees of freedom.
double normal_quantile_of_scores(std::span<const double> scores, std::span<const std::size_t> groups, int rows,
                                 double share);

/// The expected square of the tool error (see tool_error_m()) that the posterior alone gives at a pose, m^2: what noise
/// and model error add is not in it. Where only distances were measured, of their root mean square.
double posterior_square_m2(const Posterior& posterior, const CorrectedRobot& robot, const DataSet& data,
                           const MeasuredPose& pose);

/// The expected square that noise and model error add at a pose, m^2.
double noise_square_m2(const PredictionInterval& interval, const MeasuredPose& pose);

/// The radius that holds 95 % of the tool errors measured at that pose, m. Its measurement noise is in it.
double radius95_m(const PredictionInterval& interval, const Posterior& posterior, const CorrectedRobot& robot,
                  const DataSet& data, const MeasuredPose& pose);

/// The radius about the predicted point of the robot's own tool that holds the real one 95 % of the time, m: without
/// measurement noise.
double real_radius95_m(const PredictionInterval& interval, const Posterior& posterior, const CorrectedRobot& robot,
                       const Stop& stop);

}  // namespace demecal
