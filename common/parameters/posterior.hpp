// How surely a fitted model knows where the tool goes: the covariance of its numbers, the radii that hold 95 % of its
// errors, and how far its tool is really off over all the places its joints were measured at.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <map>
#include <span>
#include <string>
#include <vector>

#include "data/data_set.hpp"
#include "effects/arm_state.hpp"
#include "expression/bound.hpp"
#include "kinematics/chain.hpp"
#include "parameters/declared_model.hpp"
#include "parameters/parameter_space.hpp"
#include "parameters/widening.hpp"
#include "prediction/corrected_robot.hpp"
#include "random/random_stream.hpp"

namespace demecal::inline parameters {

/// A shape that a joint's correction could hold more or less of, in rad of theta in rad.
struct CorrectionTerm {
  int joint = 0;  ///< from 0
  JointCorrection shape;
};

/// The covariance of a model's numbers after a fit, wide along what the poses did not show: factor * factor^T.
struct Posterior {
  std::vector<ParameterId> ids;       ///< of the model's base, links, tools and effects
  std::vector<CorrectionTerm> terms;  ///< of its joint corrections
  Eigen::MatrixXd factor;             ///< (ids, then terms) x any number; SI units and rad

  /// Without the numbers that `leave_out` names.
  template <typename LeaveOut>
  Posterior without(const LeaveOut& leave_out) const;
};

/// The tool's twist (linear m, angular rad; frame of predictions) per unit of each of the posterior's independent
/// numbers: 6 x columns of its factor.
Eigen::Matrix<double, 6, Eigen::Dynamic> pose_spread(const Posterior& posterior, const CorrectedRobot& robot,
                                                     const Stop& stop, const std::string& target = "");

/// Covariance of a tool's pose: position (m) first, then orientation (rad), in the frame of predictions.
using PoseCovariance = Eigen::Matrix<double, 6, 6>;

/// Of the pose that `robot`, whose numbers `posterior` is about, predicts for the tool of `target` (empty: its own) at
/// `stop`.
PoseCovariance pose_covariance(const Posterior& posterior, const CorrectedRobot& robot, const Stop& stop,
                               const std::string& target = "");

template <typename LeaveOut>
Posterior Posterior::without(const LeaveOut& leave_out) const {
  Posterior rest{{}, terms, {}};
  std::vector<Eigen::Index> rows;
  for (std::size_t i = 0; i < ids.size(); ++i) {
    if (leave_out(ids[i])) continue;
    rest.ids.push_back(ids[i]);
    rows.push_back(static_cast<Eigen::Index>(i));
  }
  for (std::size_t i = 0; i < terms.size(); ++i) rows.push_back(static_cast<Eigen::Index>(ids.size() + i));
  rest.factor = factor(rows, Eigen::all);
  return rest;
}

/// The same knowledge where the base stands turned by `turn` in the frame of the measurements: the base's numbers are
/// counted along that frame's axes, and what they share with the arm's numbers turns with them.
Posterior with_turned_base(Posterior posterior, const Eigen::Matrix3d& turn);

/// What a radius needs beside the model's posterior. Deviations are standard deviations per axis, m.
struct PredictionInterval {
  double quantile = 0.0;          ///< of scores |error| / deviation; radii are so many deviations
  double noise_m = 0.0;           ///< of measured positions: of repeats or, without any, of the fit's residuals
  double distance_noise_m = 0.0;  ///< the same of measured distances
  double model_error_m = 0.0;     ///< what the poses behind the quantile show beyond noise and posterior
  std::size_t poses = 0;          ///< behind the quantile, repeats of one pose counted once
  std::size_t gross_errors = 0;   ///< poses left out of it as far out
  bool fitted = false;            ///< the poses behind it are those of the fit: no others were there
  /// In place of noise_m, at poses of the stations that it names; the first one's name is empty.
  std::map<std::string, double> station_noise_m{};
  bool along_path = false;  ///< the poses of the data follow each other
};

/// What is to be said of radii that come from such poses.
inline constexpr const char* kAlongPathRemark =
    "the poses of the calibration follow each other along a path: at poses far from it the intervals may be too "
    "narrow, although every joint was measured there";

/// What is known of a model's numbers once its base and tools were fitted to `poses` of `data` (fit_registration, which
/// made `registered`) while all else stayed as it was: the fit makes up for what the arm's numbers (`posterior`) are
/// wrong by, and errs by the noise of those poses. Along what these do not show, base and tools are as wide as those of
/// a model.
Posterior registered_posterior(const Posterior& posterior, const PredictionInterval& interval,
                               const CorrectedRobot& registered, const DataSet& data,
                               std::span<const std::size_t> poses);

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

/// The radius that holds 95 % of the tool errors measured at that pose, m. Its measurement noise is in it (that of all
/// stations, where `data` are of one: another one's than the model's, perhaps); all else is larger as widening() says.
double radius95_m(const PredictionInterval& interval, const Posterior& posterior, const CorrectedRobot& robot,
                  const DataSet& data, const MeasuredPose& pose, const Widening& there_by = {});

/// What a corrected position's radius that holds 95 % is, in root mean squares of what the model's numbers and its own
/// error give: of normal errors, since the interval's quantile has the tails of measurement noise, and is told by few
/// poses.
double real_quantile();

/// The coverage factor of all expanded uncertainties: radii that hold 95 % are so many standard uncertainties.
inline constexpr double kCoverageFactor = 2.0;

/// The radius about the predicted point of the robot's own tool that holds the real one 95 % of the time, m: without
/// measurement noise, by real_quantile(), and larger as widening() says.
double real_radius95_m(const PredictionInterval& interval, const Posterior& posterior, const CorrectedRobot& robot,
                       const Stop& stop, const Widening& there_by = {});

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

}  // namespace demecal::inline parameters
